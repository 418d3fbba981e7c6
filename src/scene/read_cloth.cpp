#include "scene/read_parts.h"

namespace weft {
namespace {

void read_grid(TomlTable& cloth, ClothParams& params) {
    if (!cloth.has("grid")) {
        return;
    }
    TomlTable grid = cloth.table("grid");
    grid.read("size", params.grid_size);
    grid.read("cells", params.grid_cells);
    grid.finish();
}

void read_adapt(TomlTable& cloth, AdaptParams& params) {
    if (!cloth.has("adapt")) {
        return;
    }
    TomlTable adapt = cloth.table("adapt");
    params.levels = k_default_levels;
    adapt.read("levels", params.levels);
    adapt.read("curvature", params.curvature);
    adapt.read("contact", params.contact);
    adapt.read("compression", params.compression);
    adapt.read("velocity", params.velocity);
    adapt.read("max_triangles", params.max_triangles);
    adapt.finish();
    adapt.refuse(problem(params));
}

void read_mechanics(TomlTable& table, ClothParams& params) {
    read_model(table, params.model, SpringOwner::Cloth);
    read_spring(table, params.model, params.spring, SpringOwner::Cloth);
    read_adapt(table, params.adapt);
    if (params.model != Model::Corotational && params.adapt.levels > 0) {
        table.fail("adapt", "must be left out: only corotational cloth is refined");
    }
    table.read_choice("bending", params.bend_model,
                      {{"quadratic", BendModel::Quadratic}, {"mid_edge", BendModel::MidEdge}});
    table.read_choice("rest", params.rest, {{"mesh", RestShape::Mesh}, {"uv", RestShape::Uv}});
    table.read("uv_scale", params.uv_scale);
    table.read("grain_deg", params.grain_deg);
    table.read("pressure", params.pressure);
    table.read("layer", params.layer);
    table.read("velocity", params.velocity);
}

} // namespace

ClothParams read_cloth(TomlTable table,
                       const std::filesystem::path& base_dir,
                       const std::vector<std::string>& obstacles) {
    ClothParams params;
    params.name = read_name(table);
    const bool has_grid = table.has("grid");
    read_grid(table, params);
    read_mesh_source(table, params.mesh);
    read_placement(table, params.placement);
    read_mechanics(table, params);
    read_fabric(table, base_dir, params.fabric);
    for (const TomlTable& pin : table.tables("pin")) {
        params.pins.push_back(read_pin(pin, obstacles));
    }
    table.finish();
    table.refuse(problem(params));
    if (params.name.empty()) {
        table.fail("needs name");
    }
    if (has_grid == !params.mesh.file.empty()) {
        table.fail(has_grid ? "has mesh and grid: must be one of them" : "needs mesh or grid");
    }
    return params;
}

} // namespace weft
