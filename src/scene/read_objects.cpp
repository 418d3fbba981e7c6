#include "scene/read_objects.h"

#include "scene/fabric.h"
#include "scene/key.h"
#include "scene/law_shape.h"
#include "scene/names.h"
#include "scene/toml_keys.h"

#include <fmt/core.h>

#include <algorithm>

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

namespace {

/// A preset's name, or the path of a .toml file, as the user wrote it under `key`.
FabricParams
named_fabric(TomlTable& table, std::string_view key, const std::filesystem::path& base_dir) {
    std::string name;
    table.read(key, name);
    if (name.ends_with(".toml")) {
        const std::filesystem::path file = base_dir / name;
        if (!std::filesystem::is_regular_file(file)) {
            table.fail(key, fmt::format("there is no file {}", file.string()));
        }
        return read_fabric_file(file);
    }
    if (const Fabric* preset = find_fabric(name)) {
        return preset->params;
    }
    const std::vector<std::string> names = fabric_names();
    table.fail(key, fmt::format("must be a preset (weft fabric list) or a .toml file; the nearest "
                                "preset is {}",
                                nearest_key(name, names)));
}

/// The key `fabric` of a cloth: a preset, a file, or a table.
void read_fabric(TomlTable& cloth, const std::filesystem::path& base_dir, FabricParams& fabric) {
    if (!cloth.has("fabric")) {
        return;
    }
    if (cloth.is_string("fabric")) {
        fabric = named_fabric(cloth, "fabric", base_dir);
        return;
    }
    if (!cloth.is_table("fabric")) {
        cloth.fail("fabric", "must be the name of a preset, a .toml file, or a table");
    }
    TomlTable table = cloth.table("fabric");
    if (table.has("base")) {
        fabric = named_fabric(table, "base", base_dir);
        fabric.name += ", altered";
    }
    read_fabric_values(table, fabric);
}

void read_adapt(TomlTable& cloth, AdaptParams& params) {
    if (!cloth.has("adapt")) {
        return;
    }
    TomlTable adapt = cloth.table("adapt");
    params.levels = k_default_levels;
    read_keys(adapt, keys_of(params));
    adapt.finish();
    adapt.refuse(problem(params));
}

/// Keys that would silently do nothing where the user expects them to hold.
void refuse_unused(TomlTable& spring, Model model, SpringOwner owner) {
    if (model == Model::StvkTriangle && spring.has("limit")) {
        spring.fail("limit", "must be left out: stvk_triangle has no edges to limit");
    }
    if (owner == SpringOwner::Solid) {
        for (const char* key : {"bend", "calibrate"}) {
            if (spring.has(key)) {
                spring.fail(key, "must be left out: of cloth only");
            }
        }
    }
}

/// How many of the keys that say which vertices a pin holds are there.
int count_selections(TomlTable& table, PinParams& pin) {
    if (table.has("vertices") && pin.vertices.empty()) {
        table.fail("vertices", "must name at least one vertex");
    }
    pin.has_box = table.has("box");
    if (pin.has_box) {
        TomlTable box = table.table("box");
        if (!box.has("min") || !box.has("max")) {
            box.fail("needs min and max");
        }
    }
    return static_cast<int>(table.has("vertices")) + static_cast<int>(pin.has_box) +
           static_cast<int>(pin.corners) + static_cast<int>(table.has("loop"));
}

} // namespace

void read_fabric_values(TomlTable& table, FabricParams& fabric) {
    if (table.has("friction")) {
        fabric.static_friction.reset();
    }
    read_keys(table, keys_of(fabric));
    if (fabric.name.empty()) {
        table.fail("name", "must not be empty");
    }
    table.finish();
    table.refuse(problem(fabric));
}

void read_spring(TomlTable& owner, Model model, SpringParams& params, SpringOwner kind) {
    if (!owner.has("spring")) {
        return;
    }
    TomlTable spring = owner.table("spring");
    if (model == Model::Corotational) {
        spring.fail("is of edge models: needs model = \"cubic\", \"linear\", \"stvk_edge\" or "
                    "\"stvk_triangle\"");
    }
    read_keys(spring, keys_of(params, model, kind));
    refuse_unused(spring, model, kind);
    spring.finish();
    spring.refuse(problem_of(keys_of(params, model, kind)));
    if (const std::string text = softening_text(model, params); params.strict && !text.empty()) {
        spring.fail("strict", "refuses this law: " + text);
    }
}

PinParams read_pin(TomlTable table, const std::vector<std::string>& leaders) {
    PinParams pin;
    read_keys(table, keys_of(pin));
    const int selections = count_selections(table, pin);
    table.finish();
    table.refuse(problem(pin));
    if (selections != 1) {
        table.fail("must have exactly one of vertices, box, corners = true and loop");
    }
    if (table.has("to") && std::find(leaders.begin(), leaders.end(), pin.to) == leaders.end()) {
        const std::string nearest = nearest_key(pin.to, leaders);
        table.fail("to", nearest.empty()
                             ? "must be the name of an obstacle or rigid body; the scene has none"
                             : "must be the name of an obstacle or rigid body; the nearest is " +
                                   nearest);
    }
    return pin;
}

ClothParams read_cloth(TomlTable table,
                       const std::filesystem::path& base_dir,
                       const std::vector<std::string>& leaders) {
    ClothParams params;
    read_keys(table, keys_of(params));
    check_name(table, params.name);
    check_mesh_source(table, params.mesh);
    read_spring(table, params.model, params.spring, SpringOwner::Cloth);
    read_adapt(table, params.adapt);
    if (params.model != Model::Corotational && params.adapt.levels > 0) {
        table.fail("adapt", "must be left out: only corotational cloth is refined");
    }
    read_fabric(table, base_dir, params.fabric);
    for (const TomlTable& pin : table.tables("pin")) {
        params.pins.push_back(read_pin(pin, leaders));
    }
    table.finish();
    table.refuse(problem(params));
    if (params.name.empty()) {
        table.fail("needs name");
    }
    const bool has_grid = table.has("grid");
    if (has_grid == !params.mesh.file.empty()) {
        table.fail(has_grid ? "has mesh and grid: must be one of them" : "needs mesh or grid");
    }
    return params;
}

} // namespace weft
