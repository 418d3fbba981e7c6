#pragma once

#include "base/eigen.h"

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// What the user can ask of each algorithm: plain values with default, unit and range. The keys of
/// the scene file that set them are described in scene/scene_keys.h.
namespace weft {

inline constexpr double k_forever = std::numeric_limits<double>::infinity();

inline constexpr double k_earth_gravity = 9.81; ///< m/s^2

enum class Integrator { Euler, Bdf2 };

/// `[scene]`: time, integration, gravity, air.
struct SceneParams {
    int frames = 100;  ///< written; frame n is t = (n-1)/fps; >= 1
    double fps = 25.0; ///< 1/s, > 0
    int substeps = 0;  ///< a frame; 0 = automatic; >= 0
    Integrator integrator = Integrator::Euler;
    int newton = 1;                 ///< iterations a substep; 1 = one linearisation; 1..100
    double solver_tolerance = 1e-4; ///< residual of the linear solve relative to its right-hand
                                    ///< side; larger: softer, noisier cloth; (0, 0.1]
    Vec3 gravity{0.0, -k_earth_gravity, 0.0}; ///< m/s^2
    Vec3 wind{0.0, 0.0, 0.0};                 ///< m/s
    double air_density = 1.2;                 ///< kg/m^3; 0 = no air
    bool operator==(const SceneParams&) const = default;
};

enum class StartOverlap { Error, Grow, Untangle };

/// `[[contact.friction]]`: coefficients of two objects in place of those mixed from their own.
struct FrictionPair {
    std::array<std::string, 2> between{};    ///< names; twice the same: the object with itself
    double friction = 0.3;                   ///< Coulomb, kinetic, >= 0
    std::optional<double> static_friction{}; ///< >= friction; none: friction
    bool operator==(const FrictionPair&) const = default;
};

/// `[contact]`.
struct ContactParams {
    StartOverlap start_overlap = StartOverlap::Error;
    bool self = true;    ///< cloth against itself and against other cloth
    bool enabled = true; ///< false: nothing touches anything (for tests of the mechanics)
    std::vector<FrictionPair> friction{}; ///< at most one for two objects
    bool operator==(const ContactParams&) const = default;
};

/// Placement in the world, applied in the order scale, rotate (about x, then y, then z), translate.
struct Placement {
    Vec3 translate{0.0, 0.0, 0.0};  ///< m
    Vec3 rotate_deg{0.0, 0.0, 0.0}; ///< degrees
    double scale = 1.0;             ///< > 0
    bool operator==(const Placement&) const = default;
};

/// Where a mesh comes from and how its file is to be read.
struct MeshSource {
    std::string file{};                 ///< relative to the scene; empty: none
    std::vector<std::string> objects{}; ///< nodes or meshes inside the file; empty: all
    double metres_per_unit = 1.0;       ///< the file's unit; > 0
    bool units_given = false;           ///< false: the file's own unit (FBX) or metres
    char up = 'y';                      ///< 'y' or 'z' in the file
    bool up_given = false;              ///< false: the file's own axes (FBX, ...) or 'y'
    bool repair = false;                ///< drop degenerate triangles instead of refusing them
    bool operator==(const MeshSource&) const = default;
};

/// `[cloth.fabric]`: one material. Direction 1 is weft (u), direction 2 is warp (v).
struct FabricParams {
    std::string name = "custom";
    double area_density = 0.15;             ///< key `density`, kg/m^2, > 0
    Vec2 stretch_stiffness{1000.0, 1000.0}; ///< key `stretch`: weft, warp; N/m, > 0
    double shear_stiffness = 400.0;         ///< key `shear`, N/m, > 0
    double poisson = 0.3;                   ///< sqrt(nu12 nu21), [0, 1)
    double bend_stiffness = 1.0e-5;         ///< key `bend`: rigidity, N m, >= 0
    double thickness = 1.0e-3;              ///< contact thickness, m, > 0
    double friction = 0.3;                  ///< Coulomb, kinetic, >= 0
    std::optional<double> static_friction;  ///< >= friction; none: friction
    Vec2 damping{0.0, 0.0};                 ///< Rayleigh: mass 1/s, stiffness s; >= 0
    Vec2 working_range{0.9, 1.2};           ///< key `range`: stretch, for the colour map
    bool operator==(const FabricParams&) const = default;
};

enum class BendModel { Quadratic, MidEdge };

/// One `[[cloth.pin]]`: which vertices are held, how they move, how long.
struct PinParams {
    std::vector<Index> vertices; ///< in the imported mesh, after welding
    bool has_box = false;
    Vec3 box_min{0.0, 0.0, 0.0}; ///< m, world, at t = 0
    Vec3 box_max{0.0, 0.0, 0.0};
    bool corners = false;     ///< the corners of the rest shape's boundary
    int loop = -1;            ///< boundary loop: 0 = longest ...; -1 = none
    std::string loop_side;    ///< or "top", "bottom": the loop that lies highest, lowest
    double until = k_forever; ///< s
    std::vector<std::array<double, 4>> move; ///< key frames t, x, y, z (s, m): offset
    std::string to;                          ///< obstacle or rigid body to follow; empty: none
    bool operator==(const PinParams&) const = default;
};

enum class RestShape { Mesh, Uv };

/// `[cloth.adapt]`: where the mesh is refined while it moves; without the table it stays as it is.
/// A criterion that is 0 or false is not asked.
struct AdaptParams {
    int levels = 0;            ///< sqrt(3) levels finer than the import; 0: none
    double curvature = 0.15;   ///< mean curvature times triangle size, >= 0
    bool contact = true;       ///< as if curved like the obstacle that comes near
    double compression = 0.02; ///< of a triangle in its plane, as a fraction, [0, 1)
    double velocity = 0.0;     ///< change of velocity across a triangle, m/s, >= 0
    int max_triangles = 100000;
    bool operator==(const AdaptParams&) const = default;
};

/// Levels that `[cloth.adapt]` has when it does not say.
inline constexpr int k_default_levels = 4;

/// What holds an object together. All but Corotational are those of Vogiannou et al. 2010.
enum class Model {
    Corotational, ///< linear triangles, corotated
    Cubic,        ///< edges with a full cubic force
    Linear,       ///< edges that are Hookean springs
    StvkEdge,     ///< edges with the two-term cubic force of Kikuuwe et al. 2009
    StvkTriangle, ///< Saint Venant-Kirchhoff triangles of Volino et al. 2009; cloth only
};

/// `[cloth.spring]`, `[solid.spring]`: the force law of edge models. Stiffness is that of one edge,
/// dg/dr of its tension g at length r; a1, a2 are stretches, length over rest length.
struct SpringParams {
    double K = 1000.0;             ///< at rest, N/m, > 0
    double K1 = 6000.0;            ///< at a1, N/m, > 0; cubic only
    double K2 = 2000.0;            ///< at a2, N/m, > 0; cubic only
    double a1 = 1.1;               ///< > 1
    double a2 = 0.9;               ///< in (0, 1)
    double bend = 10.0;            ///< K of edges that resist bending, N/m, >= 0; 0: none; cloth
    double shear = 1.0;            ///< stiffness of diagonals over that of sides, >= 0; 0: none
    double damping = 0.0;          ///< along the relative velocity of the ends, N s/m, >= 0
    double jacobian_damping = 1.0; ///< factor of b and d in the Jacobian alone, (0, 1]; 1: off
    Vec2 limit{0.0, 0.0};          ///< least and greatest stretch that must hold; zeros: none
    double mass = 1.0;             ///< the whole object's, kg, > 0
    bool strict = false;           ///< refuse laws whose stiffness turns negative somewhere
    bool calibrate = false;        ///< K of each edge from the moduli of the fabric instead
    bool operator==(const SpringParams&) const = default;
};

/// `[[cloth]]`.
struct ClothParams {
    std::string name;
    MeshSource mesh;          ///< file empty: the grid
    Vec2 grid_size{1.0, 1.0}; ///< m; x, z; centred
    std::array<int, 2> grid_cells{32, 32};
    Placement placement;
    Vec3 velocity{0.0, 0.0, 0.0}; ///< at the start, m/s
    Model model = Model::Corotational;
    FabricParams fabric;
    SpringParams spring;
    BendModel bend_model = BendModel::MidEdge;
    RestShape rest = RestShape::Mesh;
    double uv_scale = 1.0;  ///< metres per unit of uv, > 0
    double grain_deg = 0.0; ///< turns weft and warp in the rest shape, counter-clockwise
    double pressure = 0.0;  ///< inside closed cloth, Pa
    int layer = 0;          ///< higher is outside
    AdaptParams adapt;
    std::vector<PinParams> pins;
    bool operator==(const ClothParams&) const = default;
};

enum class Shape { Mesh, Sphere, Box, Plane };

/// A pose at a time, as an offset from the placement: translate after rotate about the own origin.
struct PoseKey {
    double t = 0.0;                 ///< s
    Vec3 translate{0.0, 0.0, 0.0};  ///< m
    Vec3 rotate_deg{0.0, 0.0, 0.0}; ///< about x, then y, then z
    bool operator==(const PoseKey&) const = default;
};

enum class AnimationEnd { Hold, Loop };

/// How the shape of an obstacle changes: an animation in its mesh file, numbered files, or a cache.
struct AnimationParams {
    std::string name{};       ///< key `animation`; empty: the file's first; "none": as modelled
    bool is_sequence = false; ///< key `sequence`: the mesh's file is a pattern, see mesh_sequence.h
    std::string cache{};      ///< PC2 or MDD, relative to the scene; empty: none
    double fps = 0.0;         ///< key `sequence_fps`: files or samples, 1/s; 0: the scene's, or
                              ///< the times in an MDD
    double start = 0.0;       ///< key `animation_start`: when it leaves its first pose, s
    double speed = 1.0;       ///< key `animation_speed`, > 0
    AnimationEnd end = AnimationEnd::Hold; ///< key `animation_end`
    bool operator==(const AnimationParams&) const = default;
};

/// `[[obstacle]]`.
struct ObstacleParams {
    std::string name;
    Shape shape = Shape::Mesh;
    MeshSource mesh;
    AnimationParams animation;
    double radius = 0.1;      ///< sphere, m, > 0
    Vec3 size{1.0, 1.0, 1.0}; ///< box: edge lengths; plane: x and z extent; m, > 0
    Placement placement;
    double friction = 0.3;                   ///< Coulomb, kinetic, >= 0
    std::optional<double> static_friction{}; ///< >= friction; none: friction
    std::vector<PoseKey> motion;             ///< by ascending t; empty: static
    bool operator==(const ObstacleParams&) const = default;
};

/// `[[solid]]`: particles filled into a box or a closed mesh, joined to their neighbours.
struct SolidParams {
    std::string name;
    MeshSource mesh;         ///< file empty: the box
    bool fills_open = false; ///< key `fill = "winding"`: an open mesh is filled by winding number
    Vec3 box{0.0, 0.0, 0.0}; ///< edge lengths, m, > 0; centred
    double spacing = 0.02;   ///< between particles, m, > 0
    Placement placement;
    Vec3 velocity{0.0, 0.0, 0.0}; ///< at the start, m/s
    Model model = Model::Cubic;   ///< an edge model
    SpringParams spring;
    double thickness = 1.0e-3;               ///< contact thickness, m, > 0
    double friction = 0.3;                   ///< Coulomb, kinetic, >= 0
    std::optional<double> static_friction{}; ///< >= friction; none: friction
    std::vector<PinParams> pins;             ///< hold particles: box, move, until
    bool operator==(const SolidParams&) const = default;
};

/// `[[rigid]]`: a body that moves as a whole.
struct RigidParams {
    std::string name;
    Shape shape = Shape::Mesh; ///< not Plane
    MeshSource mesh;
    double radius = 0.1;      ///< sphere, m, > 0
    Vec3 size{1.0, 1.0, 1.0}; ///< box: edge lengths, m, > 0
    double mass = 1.0;        ///< kg, > 0; of uniform density
    Placement placement;
    Vec3 velocity{0.0, 0.0, 0.0};            ///< the centre of mass has it at the start, m/s
    Vec3 spin_deg{0.0, 0.0, 0.0};            ///< angular velocity at the start, degrees/s
    double thickness = 1.0e-3;               ///< contact thickness, m, > 0
    double friction = 0.3;                   ///< Coulomb, kinetic, >= 0
    std::optional<double> static_friction{}; ///< >= friction; none: friction
    bool operator==(const RigidParams&) const = default;
};

/// A vertex by its index, or, without one, the nearest to a place at t = 0.
struct VertexChoice {
    Index vertex = k_no_index; ///< in the imported mesh, after welding
    Vec3 place{0.0, 0.0, 0.0}; ///< m, world
    bool operator==(const VertexChoice&) const = default;
};

/// One side of an `[[attach]]`: points of a cloth. Of a seam either `vertices`, or the border from
/// `from` to `to`; of a button either `vertices`, or `at`, or neither: what is nearest to the other
/// side.
struct AttachSide {
    std::string cloth;
    std::vector<Index> vertices;
    std::optional<VertexChoice> from, to;
    std::optional<VertexChoice> via; ///< on the way; without it the shorter way round the border
    std::optional<Vec3> at;          ///< m, world, at t = 0: the nearest point of the cloth
    bool operator==(const AttachSide&) const = default;
};

enum class AttachKind { Seam, Button };

/// `[[attach]]`: points of cloth pulled together and then held.
struct AttachParams {
    std::string name;
    AttachKind kind = AttachKind::Seam;
    AttachSide a, b;
    double start = 0.0;       ///< when it begins to pull, s, >= 0
    double close = 1.0;       ///< how long it takes to close, s, >= 0
    double until = k_forever; ///< when it lets go, s
    double strength = 20.0;   ///< most it pulls while it closes: N a metre of seam, N a button; > 0
    double radius = 0.05;     ///< how far a place may be from the cloth it stands for, m, > 0
    bool weld = true;         ///< once closed, held for good; false: pulled by `strength` at most
    bool operator==(const AttachParams&) const = default;
};

struct CameraParams {
    Vec3 eye{0.0, 1.0, 3.0};
    Vec3 target{0.0, 0.0, 0.0};
    double fov_deg = 35.0; ///< vertical, (0, 170)
    bool operator==(const CameraParams&) const = default;
};

/// `[render]`.
struct RenderParams {
    std::array<int, 2> size{1280, 720}; ///< pixels
    std::string quantity = "stretch";   ///< see scene/quantities.h
    std::string map = "coolwarm";
    bool has_range = false;
    Vec2 range{0.9, 1.2}; ///< in the quantity's unit
    bool edges = true;
    bool legend = true;
    bool problems = false; ///< rings around unresolved pairs
    bool has_camera = false;
    CameraParams camera;
    int supersample = 2; ///< per axis, on top of 4 samples a pixel; 1..4
    bool enabled = true; ///< false: a simulation writes no pictures
    bool operator==(const RenderParams&) const = default;
};

/// A scene as the user wrote it, with defaults filled in and fabrics looked up; checked, nothing
/// loaded.
struct Scene {
    std::filesystem::path base_dir; ///< what relative paths in it are relative to
    SceneParams scene;
    ContactParams contact;
    std::vector<ClothParams> cloths;
    std::vector<SolidParams> solids;
    std::vector<RigidParams> rigids;
    std::vector<ObstacleParams> obstacles;
    std::vector<AttachParams> attachments;
    RenderParams render;
};

} // namespace weft
