#include "scene/scene_keys.h"

#include <fmt/core.h>

#include <cmath>

namespace weft {
namespace {

Key name_key(std::string& name) {
    return {"name", &name,     "", "", "unique; names files: letters, digits, `_`, `-`, at most 64",
            "",     "required"};
}

/// How the file of a mesh is read.
Keys file_keys(MeshSource& p) {
    return {
        {"object", &p.objects, "", "", "node or mesh inside the file, or a list of them", "",
         "all"},
        Key{"units", Units{&p.metres_per_unit}, "", "> 0 m, or \"m\", \"cm\", \"mm\" or \"in\"",
            "metres per unit of the file, or \"m\", \"cm\", \"mm\", \"in\"",
            "m per unit of the file", "the file's, else \"m\""}
            .written_if(p.units_given),
        Key{"up", one_of(p.up, {{"y", 'y'}, {"z", 'z'}}), "", "",
            "the axis of the file that points up", "", "the file's, else \"y\""}
            .written_if(p.up_given),
        Key{"repair", &p.repair, "", "", "drop degenerate triangles instead of refusing them"}
            .written_if(!p.file.empty()),
    };
}

Keys mesh_keys(MeshSource& p, std::string meaning) {
    return Keys{{"mesh", Path{&p.file}, "", "", std::move(meaning), "", "none"}} + file_keys(p);
}

Keys placement_keys(Placement& p) {
    return {
        {"translate", &p.translate, "m", "", "moves the object, after `scale` and `rotate_deg`"},
        {"rotate_deg", &p.rotate_deg, "degrees", "", "turns it about x, then y, then z",
         "about x, then y, then z"},
        {"scale", &p.scale, "", "> 0", "first of the three"},
    };
}

Key velocity_key(Vec3& velocity) {
    return {"velocity", &velocity, "m/s", "", "velocity at the start"};
}

Key thickness_key(double& thickness) {
    return {"thickness", &thickness, "m", "> 0", "thickness of contact"};
}

Keys keys_of(AnimationParams& p) {
    return {
        {"animation", &p.name, "", "",
         "what the mesh file plays: skins, morph targets and moving nodes of FBX, glTF, X, DAE "
         "...; \"none\": the mesh as modelled. `weft inspect` lists them",
         "", "the file's first"},
        {"cache", Path{&p.cache}, "", "",
         "point cache, `.pc2` or `.mdd`, that moves the vertices of `mesh`, in the file's own "
         "order (OBJ: of its `v` lines)",
         "", "none"},
        Key{"sequence_fps", &p.fps, "1/s", Range("> 0 and <= 1000000, 1/s", 0.0, 1e6),
            "files of `sequence`, or samples of `cache`, a second", "",
            "the scene's; of an MDD its own times"}
            .written_if(p.fps > 0.0),
        {"animation_start", &p.start, "s", "", "when it leaves its first pose"},
        {"animation_speed", &p.speed, "", "> 0 and <= 1000000", "2 = twice as fast"},
        {"animation_end",
         one_of(p.end, {{"hold", AnimationEnd::Hold}, {"loop", AnimationEnd::Loop}}), "", "",
         "\"hold\" the last pose or \"loop\""},
    };
}

/// `key = value: must be > EARLIER s, the time before`, or "".
std::string time_problem(const std::string& key, double earlier, double later) {
    return later > earlier
               ? ""
               : fmt::format("{} = {}: must be > {} s, the time before", key, later, earlier);
}

} // namespace

Keys keys_of(FabricParams& p) {
    const Range above_first =
        more_than(p.working_range[0], fmt::format("> range[0], {}", p.working_range[0]));
    return Keys{
               {"base", Elsewhere{}, "", "", "preset or file whose values are taken first", "",
                "none"},
               {"name", &p.name, "", "", "shown in the legend"},
               {"density", &p.area_density, "kg/m^2", "> 0", "mass per area"},
               {"stretch", &p.stretch_stiffness, "N/m", "> 0",
                "membrane stiffness weft, warp (Young's modulus times thickness)",
                "weft, warp, N/m"},
               {"shear", &p.shear_stiffness, "N/m", "> 0", "membrane stiffness in shear"},
               {"poisson", &p.poisson, "", ">= 0 and < 1",
                "square root of the product of Poisson's two ratios"},
               {"bend", &p.bend_stiffness, "N m", ">= 0", "bending rigidity"},
               thickness_key(p.thickness),
           } +
           friction_keys(p.friction, p.static_friction) +
           Keys{
               {"damping", &p.damping, "", std::vector<Range>{">= 0 1/s", ">= 0 s"},
                "Rayleigh damping: of mass, of stiffness", "mass 1/s, stiffness s"},
               {"range", &p.working_range, "", std::vector<Range>{"> 0", above_first},
                "stretch in use, for the colours", "working range of stretch"},
           };
}

Keys keys_of(AdaptParams& p) {
    return {
        {"levels", &p.levels, "", "0 to 8",
         "how many sqrt(3) levels finer than the import; 0: none", "0: the mesh stays as it is"},
        {"curvature", &p.curvature, "", ">= 0",
         "refine where mean curvature times the triangle's size exceeds this (about half the angle "
         "by which the cloth turns across it); 0: not asked"},
        {"contact", &p.contact, "", "",
         "refine also where an obstacle comes near that is as curved as that, or that has a sharp "
         "ridge"},
        {"compression", &p.compression, "", "0 to below 1",
         "refine where a triangle is compressed by more than this fraction, or what buckles waves "
         "of its own size if that is more; 0: not asked. Thin cloth folds at 0.001 to 0.003; where "
         "it lands hard such a limit refines all of it"},
        {"velocity", &p.velocity, "m/s", ">= 0",
         "refine where velocity differs by more across a triangle; 0: not asked"},
        {"max_triangles", &p.max_triangles, "", ">= 1",
         "budget: there the worst triangles win, and the run goes on"},
    };
}

Keys keys_of(SpringParams& p, Model model, SpringOwner owner) {
    const bool is_cloth = owner == SpringOwner::Cloth;
    const bool is_limited = p.limit != Vec2(0.0, 0.0);
    return {
        {"K", &p.K, "N/m", "> 0", "stiffness of an edge at rest", "N/m at rest"},
        {"K1", &p.K1, "N/m", "> 0", "stiffness at the stretch a1; \"cubic\" only", "N/m at a1"},
        {"K2", &p.K2, "N/m", "> 0", "stiffness at the stretch a2; \"cubic\" only", "N/m at a2"},
        {"a1", &p.a1, "", "> 1, a stretch", "stretch at which K1 holds"},
        {"a2", &p.a2, "", "> 0 and < 1, a stretch", "stretch at which K2 holds"},
        Key{"bend", &p.bend, "N/m", ">= 0", "K of edges that resist bending; 0: none; cloth only"}
            .written_if(is_cloth),
        {"shear", &p.shear, "", ">= 0", "stiffness of diagonals over that of sides; 0: none",
         "diagonals over sides"},
        {"damping", &p.damping, "N s/m", ">= 0",
         "damping along the relative velocity of an edge's ends"},
        {"jacobian_damping", &p.jacobian_damping, "", "> 0 and <= 1",
         "the paper's factor of b and d in the Jacobian alone: strong damping that depends on the "
         "time step; 1 = off",
         "1: off"},
        Key{"limit", &p.limit, "",
            std::vector<Range>{">= 0 and < 1, the least stretch", "> 1, the greatest stretch"},
            "least and greatest stretch that hold whatever the load, `[0.9, 1.1]`; zeros: none",
            "zeros: none"}
            .checked_if(is_limited)
            .written_if(model != Model::StvkTriangle),
        {"mass", &p.mass, "kg", "> 0", "mass of the whole object"},
        {"strict", &p.strict, "", "",
         "refuse laws whose stiffness turns negative somewhere, which else is a warning"},
        Key{"calibrate", &p.calibrate, "", "",
            "K of each edge from the moduli of the fabric instead; cloth only"}
            .written_if(is_cloth),
    };
}

Keys keys_of(PinParams& p) {
    std::vector<Range> below_max;
    for (Eigen::Index i = 0; i < 3; ++i) {
        below_max.push_back(
            at_most(p.box_max[i], fmt::format("<= box.max[{}], {} m", i, p.box_max[i])));
    }
    return {
        {"vertices", &p.vertices, "", ">= 0, the index of a vertex",
         "indices after welding (`weft inspect` counts them)", "", "none"},
        Key{"box",
            Inline{{{"min", &p.box_min, "m", below_max, "least corner"},
                    {"max", &p.box_max, "m", "", "greatest corner"}}},
            "m", "", "the vertices inside, in the world at t = 0", "", "none"}
            .checked_if(p.has_box)
            .written_if(p.has_box),
        Key{"corners", &p.corners, "", "", "the corners of the border"}.written_if(p.corners),
        {"loop", Loop{&p.loop, &p.loop_side}, "", ">= 0, \"top\" or \"bottom\"",
         "border: \"top\", \"bottom\", or its number, 0 = longest", "", "none"},
        {"until", &p.until, "s", ">= 0", "when it lets go", "", "for ever"},
        {"move", &p.move, "", "", "key frames `[[t, x, y, z], ...]`: offset, s and m", "t, x, y, z",
         "none"},
        {"to", &p.to, "", "",
         "follow this obstacle, or hang on this rigid body and it on the cloth", "", "none"},
    };
}

Keys keys_of(ClothParams& p) {
    return Keys{
               name_key(p.name),
               Key{"grid",
                   Inline{{{"size", &p.grid_size, "m", "> 0", "extent along x and z"},
                           {"cells", &p.grid_cells, "", "1 to 4096", "cells along x and z"}}},
                   "", "", "a flat sheet in x-z, centred; or `mesh`"}
                   .written_if(p.mesh.file.empty()),
           } +
           mesh_keys(p.mesh, "mesh file; or `grid`") + placement_keys(p.placement) +
           Keys{
               velocity_key(p.velocity),
               {"model",
                one_of(p.model, {{"corotational", Model::Corotational},
                                 {"cubic", Model::Cubic},
                                 {"linear", Model::Linear},
                                 {"stvk_edge", Model::StvkEdge},
                                 {"stvk_triangle", Model::StvkTriangle}}),
                "", "", "a membrane of triangles, or one of the models of `[cloth.spring]`"},
               {"bending",
                one_of(p.bend_model,
                       {{"quadratic", BendModel::Quadratic}, {"mid_edge", BendModel::MidEdge}}),
                "", "", "\"mid_edge\" (accurate) or \"quadratic\" (fast)"},
               {"rest", one_of(p.rest, {{"mesh", RestShape::Mesh}, {"uv", RestShape::Uv}}), "", "",
                "rest shape: \"mesh\" as imported, \"uv\" the flat pattern"},
               {"uv_scale", &p.uv_scale, "m per unit of uv", "> 0", "size of the flat pattern"},
               {"grain_deg", &p.grain_deg, "", "",
                "turns weft and warp in the rest shape, counter-clockwise, degrees"},
               {"pressure", &p.pressure, "Pa", "", "inside closed cloth"},
               {"layer", &p.layer, "", "",
                "higher is outside: where garments cross at the start, it moves out of those below "
                "(`start_overlap`)"},
               {"fabric", Elsewhere{}, "", "", "preset, `.toml` file, or `[cloth.fabric]`", "",
                "a plain cloth"},
               {"spring", Elsewhere{}, "", "", "`[cloth.spring]`", "", "of edge models"},
               {"adapt", Elsewhere{}, "", "", "`[cloth.adapt]`", "", "none"},
               {"pin", Elsewhere{}, "", "", "`[[cloth.pin]]`", "", "none"},
           };
}

Keys keys_of(SolidParams& p) {
    const bool has_box = p.mesh.file.empty();
    return Keys{
               name_key(p.name),
               Key{"box", &p.box, "m", "> 0", "edges, each a multiple of `spacing`; or `mesh`", "",
                   "none"}
                   .checked_if(has_box)
                   .written_if(has_box),
           } +
           mesh_keys(p.mesh, "closed mesh, which is filled; or `box`") +
           Keys{
               Key{"fill", one_of(p.fills_open, {{"closed", false}, {"winding", true}}), "", "",
                   "\"winding\": an open mesh is filled by winding number"}
                   .written_if(!has_box),
               {"spacing", &p.spacing, "m", "> 0", "between particles"},
           } +
           placement_keys(p.placement) +
           Keys{
               velocity_key(p.velocity),
               {"model",
                one_of(p.model, {{"cubic", Model::Cubic},
                                 {"linear", Model::Linear},
                                 {"stvk_edge", Model::StvkEdge}}),
                "", "", "force law of the edges, with `[solid.spring]`"},
               thickness_key(p.thickness),
           } +
           friction_keys(p.friction, p.static_friction) +
           Keys{
               {"spring", Elsewhere{}, "", "", "`[solid.spring]`", "", "the law's defaults"},
               {"pin", Elsewhere{}, "", "", "`[[solid.pin]]`, by `box` alone: it holds particles",
                "", "none"},
           };
}

Keys keys_of(RigidParams& p) {
    return Keys{name_key(p.name)} + mesh_keys(p.mesh, "closed mesh; or `shape`") +
           Keys{
               {"shape", one_of(p.shape, {{"sphere", Shape::Sphere}, {"box", Shape::Box}}), "", "",
                "a sphere (`radius`) or a box (`size`); or `mesh`", "", "none"},
               Key{"radius", &p.radius, "m", "> 0", "of a sphere"}.written_if(p.shape ==
                                                                              Shape::Sphere),
               Key{"size", &p.size, "m", "> 0", "edges of a box"}.written_if(p.shape == Shape::Box),
               {"mass", &p.mass, "kg", "> 0", "of uniform density"},
           } +
           placement_keys(p.placement) +
           Keys{
               {"velocity", &p.velocity, "m/s", "", "of the centre of mass at the start"},
               {"spin_deg", &p.spin_deg, "degrees/s", "", "angular velocity at the start"},
               thickness_key(p.thickness),
           } +
           friction_keys(p.friction, p.static_friction);
}

Keys keys_of(PoseKey& p) {
    return {
        {"t", &p.t, "s", "", "time of the key frame", "", "required"},
        {"translate", &p.translate, "m", "", "offset from the placement"},
        {"rotate_deg", &p.rotate_deg, "degrees", "",
         "turns the object about its own origin: about x, then y, then z"},
    };
}

Keys keys_of(ObstacleParams& p) {
    const bool is_sequence = p.animation.is_sequence;
    const bool is_flat = p.shape == Shape::Box || p.shape == Shape::Plane;
    Keys animation = keys_of(p.animation);
    for (Key& key : animation) {
        key.is_written = key.is_written && p.shape == Shape::Mesh;
    }
    return Keys{
               name_key(p.name),
               Key{"mesh", Path{&p.mesh.file}, "", "", "mesh file; or `sequence`, or `shape`", "",
                   "none"}
                   .written_if(!is_sequence),
               Key{"sequence", Path{&p.mesh.file}, "", "",
                   "numbered mesh files of one topology, `\"body.####.obj\"`: as many digits as "
                   "marks, one mark for any number; linear in between",
                   "", "none"}
                   .written_if(is_sequence),
           } +
           file_keys(p.mesh) + animation +
           Keys{
               {"shape",
                one_of(p.shape,
                       {{"sphere", Shape::Sphere}, {"box", Shape::Box}, {"plane", Shape::Plane}}),
                "", "", "a plane lies in x-z; or `mesh`, or `sequence`", "", "none"},
               Key{"radius", &p.radius, "m", "> 0", "of a sphere"}.written_if(p.shape ==
                                                                              Shape::Sphere),
               Key{"size", &p.size, "m", "> 0", "edges of a box; x and z extent of a plane"}
                   .written_if(is_flat),
           } +
           placement_keys(p.placement) + friction_keys(p.friction, p.static_friction) +
           Keys{{"motion", &p.motion, "", "",
                 "key frames `{ t, translate, rotate_deg }`, offsets from the placement about its "
                 "own origin; on top of any animation",
                 "", "none"}};
}

std::string problem(PinParams params) {
    std::string found = problem_of(keys_of(params));
    for (std::size_t i = 1; i < params.move.size() && found.empty(); ++i) {
        found =
            time_problem(fmt::format("move[{}][0]", i), params.move[i - 1][0], params.move[i][0]);
    }
    return found;
}

std::string problem(ObstacleParams params) {
    std::string found = problem_of(keys_of(params));
    for (std::size_t i = 1; i < params.motion.size() && found.empty(); ++i) {
        found = time_problem(fmt::format("motion[{}].t", i), params.motion[i - 1].t,
                             params.motion[i].t);
    }
    return found;
}

std::string problem(SolidParams params) {
    std::string found = problem_of(keys_of(params));
    for (Eigen::Index i = 0; i < 3 && params.mesh.file.empty() && found.empty(); ++i) {
        const double scale = params.placement.scale;
        const double cells = params.box[i] * scale / params.spacing;
        const double nearest = std::max(1.0, std::round(cells));
        if (std::abs(cells - nearest) > 1e-6) {
            found = fmt::format("box[{}] = {}: must be a whole number of spacings; the nearest is "
                                "{:.9g} m",
                                i, params.box[i], nearest * params.spacing / scale);
        }
    }
    return found;
}

} // namespace weft
