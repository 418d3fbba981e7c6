#include "validation/sheet_world.h"

#include "geometry/curvature.h"
#include "state/build_world.h"

namespace weft {

Cloth& add_sheet(World& world,
                 const std::string& name,
                 const Sheet& sheet,
                 ClothParams params,
                 const std::function<Vec3(const Vec2&)>& place) {
    params.name = name;
    const ImportedMesh mesh = imported(sheet);
    Cloth& cloth = add_cloth(world, params, mesh);
    cloth.rest_areas = mixed_areas(mesh.mesh.positions, cloth.triangles); // to the last digit
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        const std::size_t v = at(cloth.first_vertex) + i;
        world.masses[v] = params.fabric.area_density * cloth.rest_areas[i];
        if (place) {
            world.positions[v] = world.previous_positions[v] = place(sheet.points[i]);
        }
    }
    return cloth;
}

World sheet_world(const Sheet& sheet,
                  const ClothParams& params,
                  const std::function<Vec3(const Vec2&)>& place) {
    World world;
    add_sheet(world, "sheet", sheet, params, place);
    return world;
}

SceneParams empty_space() {
    SceneParams params;
    params.gravity.setZero();
    params.air_density = 0.0;
    params.solver_tolerance = 1e-12;
    return params;
}

FabricParams isotropic_membrane(double modulus, double poisson) {
    FabricParams fabric;
    fabric.stretch_stiffness = Vec2(modulus, modulus);
    fabric.poisson = poisson;
    fabric.shear_stiffness = modulus / (2.0 * (1.0 + poisson));
    fabric.bend_stiffness = 0.0;
    return fabric;
}

std::vector<Index> vertices_where(const Sheet& sheet,
                                  const std::function<bool(const Vec2&)>& is_in) {
    std::vector<Index> picked;
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        if (is_in(sheet.points[i])) {
            picked.push_back(static_cast<Index>(i));
        }
    }
    return picked;
}

ClampedStrip::ClampedStrip(
    Pattern pattern, int cells, int cells_across, double length, double width)
    : sheet(make_sheet(pattern, cells + 1, cells_across, cells + 1, cells_across)),
      cell(length / (cells + 0.5)) {
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        Vec2& p = sheet.points[i];
        if (i % static_cast<std::size_t>(cells + 2) == 1) {
            p = Vec2(1.0, std::round(p.y())); // the clamp's line is straight
        }
        p = Vec2((p.x() - 1.0) * cell, p.y() * width / cells_across);
    }
}

std::vector<Index> ClampedStrip::clamp() const {
    return vertices_where(sheet, [](const Vec2& p) { return p.x() < 1e-9; });
}

std::vector<Index> ClampedStrip::free_end() const {
    double end = 0.0;
    for (const Vec2& p : sheet.points) {
        end = std::max(end, p.x());
    }
    return vertices_where(sheet, [=](const Vec2& p) { return p.x() > end - 1e-9; });
}

int square_cells_across(int cells, double length, double width) {
    return std::max(1, static_cast<int>(std::lround(width / length * (cells + 0.5))));
}

} // namespace weft
