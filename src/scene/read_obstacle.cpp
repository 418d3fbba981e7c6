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

void refuse_without(TomlTable& table, bool has, const char* key, const char* needs) {
    if (!has && table.has(key)) {
        table.fail(key, needs);
    }
}

void read_animation(TomlTable& table, AnimationParams& params) {
    const bool has_mesh = table.has("mesh");
    params.is_sequence = table.has("sequence");
    refuse_without(table, has_mesh, "animation", "needs mesh, whose file it is in");
    refuse_without(table, has_mesh, "cache", "needs mesh, whose vertices it moves");
    table.read("animation", params.name);
    if (table.read("cache", params.cache) && (params.cache.empty() || table.has("animation"))) {
        table.fail("cache", params.cache.empty() ? "must be the path of a point cache"
                                                 : "has animation and cache: must be one of them");
    }
    const bool has_samples = params.is_sequence || !params.cache.empty();
    refuse_without(table, has_samples, "sequence_fps", "needs sequence or cache");
    if (table.read("sequence_fps", params.fps) && params.fps == 0.0) {
        table.fail("sequence_fps", "must be > 0, 1/s");
    }
    for (const char* key : {"animation_start", "animation_speed", "animation_end"}) {
        refuse_without(table, has_mesh || params.is_sequence, key, "needs mesh or sequence");
    }
    table.read("animation_start", params.start);
    table.read("animation_speed", params.speed);
    table.read_choice("animation_end", params.end,
                      {{"hold", AnimationEnd::Hold}, {"loop", AnimationEnd::Loop}});
    table.refuse(problem(params));
}

} // namespace

ObstacleParams read_obstacle(TomlTable table) {
    ObstacleParams params;
    params.name = read_name(table);
    read_animation(table, params.animation);
    if (table.has("mesh") && params.animation.is_sequence) {
        table.fail("has mesh and sequence: must be one of them");
    }
    read_mesh_source(table, params.mesh, params.animation.is_sequence ? "sequence" : "mesh");
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
        table.fail(params.mesh.file.empty() ? "needs mesh, sequence or shape"
                                            : "has mesh and shape: must be one of them");
    }
    return params;
}

} // namespace weft
