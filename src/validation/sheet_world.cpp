#include "validation/sheet_world.h"

#include "geometry/mixed_areas.h"
#include "state/rest_shape.h"

namespace weft {

World sheet_world(const Sheet& sheet,
                  const ClothParams& params,
                  const std::function<Vec3(const Vec2&)>& place) {
    std::vector<Vec3> flat;
    for (const Vec2& p : sheet.points) {
        flat.emplace_back(p.x(), p.y(), 0.0);
    }
    Cloth cloth;
    cloth.name = "sheet";
    cloth.params = params;
    cloth.vertex_count = static_cast<Index>(flat.size());
    cloth.triangles = sheet.triangles;
    cloth.topology = build_edges(cloth.triangles);
    build_rest_shape(cloth, flat, {});
    cloth.rest_areas = mixed_areas(flat, cloth.triangles);

    World world;
    for (std::size_t i = 0; i < flat.size(); ++i) {
        world.positions.push_back(place ? place(sheet.points[i]) : flat[i]);
        world.velocities.push_back(params.velocity);
        world.masses.push_back(params.fabric.area_density * cloth.rest_areas[i]);
    }
    world.previous_positions = world.positions;
    world.previous_velocities = world.velocities;
    world.cloths.push_back(std::move(cloth));
    return world;
}

SceneParams empty_space() {
    SceneParams params;
    params.gravity.setZero();
    params.air_density = 0.0;
    params.solver_tolerance = 1e-12;
    return params;
}

FabricParams isotropic_fabric(double modulus, double poisson) {
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

} // namespace weft
