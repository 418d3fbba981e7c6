#include "scene/read_parts.h"

namespace weft {

RigidParams read_rigid(TomlTable table) {
    RigidParams params;
    params.name = read_name(table);
    read_mesh_source(table, params.mesh, "mesh");
    table.read_choice("shape", params.shape, {{"sphere", Shape::Sphere}, {"box", Shape::Box}});
    table.read("radius", params.radius);
    if (table.has("radius") && params.shape != Shape::Sphere) {
        table.fail("radius", "needs shape = \"sphere\"");
    }
    table.read("size", params.size);
    if (table.has("size") && params.shape != Shape::Box) {
        table.fail("size", "needs shape = \"box\"");
    }
    table.read("mass", params.mass);
    read_placement(table, params.placement);
    table.read("velocity", params.velocity);
    table.read("spin_deg", params.spin_deg);
    table.read("thickness", params.thickness);
    read_friction(table, params.friction, params.static_friction);
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
