#include "scene/names.h"
#include "scene/read_objects.h"
#include "scene/toml_keys.h"

namespace weft {
namespace {

void refuse_without(TomlTable& table, bool has, const char* key, const char* needs) {
    if (!has && table.has(key)) {
        table.fail(key, needs);
    }
}

/// Particles have no numbers that a user knows.
PinParams read_particle_pin(TomlTable table, const std::vector<std::string>& leaders) {
    for (const char* key : {"vertices", "corners", "loop"}) {
        if (table.has(key)) {
            table.fail(key, "is of cloth; particles are held by box");
        }
    }
    return read_pin(table, leaders);
}

/// Keys of an animation that would have nothing to play.
void check_animation(TomlTable& table, const AnimationParams& params) {
    const bool has_mesh = table.has("mesh");
    refuse_without(table, has_mesh, "animation", "needs mesh, whose file it is in");
    refuse_without(table, has_mesh, "cache", "needs mesh, whose vertices it moves");
    const bool has_cache = table.has("cache");
    if (has_cache && (params.cache.empty() || table.has("animation"))) {
        table.fail("cache", params.cache.empty() ? "must be the path of a point cache"
                                                 : "has animation and cache: must be one of them");
    }
    refuse_without(table, params.is_sequence || has_cache, "sequence_fps",
                   "needs sequence or cache");
    if (table.has("sequence_fps") && params.fps == 0.0) {
        table.fail("sequence_fps", "must be > 0, 1/s");
    }
    for (const char* key : {"animation_start", "animation_speed", "animation_end"}) {
        refuse_without(table, has_mesh || params.is_sequence, key, "needs mesh or sequence");
    }
    if (has_mesh && params.is_sequence) {
        table.fail("has mesh and sequence: must be one of them");
    }
}

} // namespace

void check_name(TomlTable& table, const std::string& name) {
    if (table.has("name") && !is_object_name(name)) {
        table.fail("name", "must be letters, digits, '_' or '-', at most 64: it names files");
    }
}

void check_mesh_source(TomlTable& table, MeshSource& source, std::string_view key) {
    source.units_given = table.has("units");
    source.up_given = table.has("up");
    if (table.has(key) && source.file.empty()) {
        table.fail(key, "must be the path of a mesh file");
    }
    for (const char* other : {"object", "units", "up", "repair"}) {
        if (source.file.empty() && table.has(other)) {
            table.fail(other, "needs mesh, whose file it describes");
        }
    }
}

SolidParams read_solid(TomlTable table, const std::vector<std::string>& leaders) {
    SolidParams params;
    read_keys(table, keys_of(params));
    check_name(table, params.name);
    check_mesh_source(table, params.mesh);
    const bool has_mesh = !params.mesh.file.empty();
    if (has_mesh == table.has("box")) {
        table.fail(has_mesh ? "has mesh and box: must be one of them" : "needs mesh or box");
    }
    refuse_without(table, has_mesh, "fill", "needs mesh, whose inside it tells");
    read_spring(table, params.model, params.spring, SpringOwner::Solid);
    for (const TomlTable& pin : table.tables("pin")) {
        params.pins.push_back(read_particle_pin(pin, leaders));
    }
    table.finish();
    table.refuse(problem(params));
    if (params.name.empty()) {
        table.fail("needs name");
    }
    return params;
}

RigidParams read_rigid(TomlTable table) {
    RigidParams params;
    read_keys(table, keys_of(params));
    check_name(table, params.name);
    check_mesh_source(table, params.mesh);
    refuse_without(table, params.shape == Shape::Sphere, "radius", "needs shape = \"sphere\"");
    refuse_without(table, params.shape == Shape::Box, "size", "needs shape = \"box\"");
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

ObstacleParams read_obstacle(TomlTable table) {
    ObstacleParams params;
    read_keys(table, keys_of(params));
    params.animation.is_sequence = table.has("sequence");
    check_name(table, params.name);
    check_animation(table, params.animation);
    check_mesh_source(table, params.mesh, params.animation.is_sequence ? "sequence" : "mesh");
    refuse_without(table, params.shape == Shape::Sphere, "radius", "needs shape = \"sphere\"");
    refuse_without(table, params.shape == Shape::Box || params.shape == Shape::Plane, "size",
                   "needs shape = \"box\" or \"plane\"");
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
