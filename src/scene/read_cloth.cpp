#include "scene/fabric.h"
#include "scene/law_shape.h"
#include "scene/nearest_key.h"
#include "scene/read_objects.h"
#include "scene/toml_keys.h"

#include <fmt/core.h>

#include <algorithm>

namespace weft {
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
