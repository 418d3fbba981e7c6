#include "scene/read_parts.h"

namespace weft {
namespace {

std::vector<PoseKey> read_motion(TomlTable& obstacle) {
    std::vector<PoseKey> motion;
    for (TomlTable& table : obstacle.tables("motion")) {
        PoseKey key;
        const bool has_time = table.read("t", key.t);
        table.read("translate", key.translate);
        table.read("rotate_deg", key.rotate_deg);
        table.finish();
        if (!has_time) {
            table.fail("needs t, the time in s");
        }
        motion.push_back(key);
    }
    return motion;
}

/// radius is a sphere's, size a box's or a plane's.
void read_shape(TomlTable& table, ObstacleParams& params) {
    table.read_choice("shape", params.shape,
                      {{"sphere", Shape::Sphere}, {"box", Shape::Box}, {"plane", Shape::Plane}});
    table.read("radius", params.radius);
    if (table.has("radius") && params.shape != Shape::Sphere) {
        table.fail("radius", "needs shape = \"sphere\"");
    }
    table.read("size", params.size);
    if (table.has("size") && params.shape != Shape::Box && params.shape != Shape::Plane) {
        table.fail("size", "needs shape = \"box\" or \"plane\"");
    }
}

} // namespace

ObstacleParams read_obstacle(TomlTable table) {
    ObstacleParams params;
    table.refuse_later("sequence");
    params.name = read_name(table);
    read_mesh_source(table, params.mesh);
    read_shape(table, params);
    read_placement(table, params.placement);
    read_friction(table, params.friction, params.static_friction);
    params.motion = read_motion(table);
    table.finish();
    table.refuse(problem(params));
    if (params.name.empty()) {
        table.fail("needs name");
    }
    if ((params.shape == Shape::Mesh) == params.mesh.file.empty()) {
        table.fail(params.mesh.file.empty() ? "needs mesh or shape"
                                            : "has mesh and shape: must be one of them");
    }
    return params;
}

} // namespace weft
