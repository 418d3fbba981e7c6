#pragma once

#include "step/advance.h"
#include "validation/experiment_world.h"

#include <numbers>
#include <string>

/// Worlds of the contact experiments: sheets and obstacles put together in code, then moved by the
/// same substeps as a simulation's.
namespace weft {

/// A mesh of a square sheet on which experiments are repeated.
struct SheetMesh {
    Pattern pattern;
    int cells; ///< a side
};

/// Substeps a frame, of 25 frames a second, and mesh: friction must not depend on either.
struct Repeat {
    int substeps;
    SheetMesh mesh;
};

/// Three substep counts, each on another mesh; `thorough`: each on each mesh.
std::vector<Repeat> repeats(bool thorough);
/// One of those alone, for experiments that take long; `thorough`: each on each.
std::vector<Repeat> few_repeats(bool thorough);
/// "2 substeps; one diagonal 4 x 4".
std::string name_of(const Repeat& repeat);

inline constexpr double k_frame_rate = 25.0;

/// No air; gravity leans forward to +x by `angle` (rad), as on an incline that falls towards +x.
SceneParams contact_space(int substeps, double angle = 0.0);

/// A place function: flat, its middle at `middle`, x to x and y to -z.
std::function<Vec3(const Vec2&)> lying(const Vec2& size, const Vec3& middle);

/// Appends a body that stands at the origin.
Obstacle& add_body(World& world, const std::string& name, TriangleMesh mesh, double friction);

/// Holds vertices of a cloth (its own indices) where they are, or on `move` from there. Once a
/// cloth, in the order of the cloths.
void hold(World& world,
          const Cloth& cloth,
          std::vector<Index> vertices,
          const std::vector<std::array<double, 4>>& move = {});

/// Side surface of a cylinder about the z axis, middle at the origin; ends open.
TriangleMesh cylinder_mesh(double radius, double length, int facets);

/// Mean over the vertices of a cloth.
Vec3 mean_position(const World& world, const Cloth& cloth);
Vec3 mean_velocity(const World& world, const Cloth& cloth);

} // namespace weft
