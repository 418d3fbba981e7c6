#include "scene/read_parts.h"

namespace weft {
namespace {

void read_inside(TomlTable& table, SolidParams& params) {
    const bool has_box = table.read("box", params.box);
    read_mesh_source(table, params.mesh);
    const bool has_mesh = !params.mesh.file.empty();
    if (has_mesh == has_box) {
        table.fail(has_box ? "has mesh and box: must be one of them" : "needs mesh or box");
    }
    table.read_choice("fill", params.fills_open, {{"closed", false}, {"winding", true}});
    if (table.has("fill") && !has_mesh) {
        table.fail("fill", "needs mesh, whose inside it tells");
    }
    table.read("spacing", params.spacing);
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

} // namespace

SolidParams read_solid(TomlTable table, const std::vector<std::string>& leaders) {
    SolidParams params;
    params.name = read_name(table);
    read_inside(table, params);
    read_placement(table, params.placement);
    table.read("velocity", params.velocity);
    read_model(table, params.model, SpringOwner::Solid);
    read_spring(table, params.model, params.spring, SpringOwner::Solid);
    table.read("thickness", params.thickness);
    read_friction(table, params.friction, params.static_friction);
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

} // namespace weft
