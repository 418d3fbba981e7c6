#include "base/error.h"
#include "scene/law_shape.h"
#include "state/build_world.h"
#include "state/calibrate_network.h"
#include "state/rest_shape.h"

#include <cassert>

namespace weft {

namespace {

/// A uv that is not in metres shows as a rest area far from the mesh's own.
constexpr double k_suspicious_area_ratio = 4.0;

void warn_of_uv_units(const Cloth& cloth, std::span<const Vec3> positions, const Warn& warn) {
    double area = 0.0;
    for (const Triangle& t : cloth.triangles) {
        const auto at = [&](std::size_t k) { return positions[static_cast<std::size_t>(t[k])]; };
        area += triangle_area(at(0), at(1), at(2));
    }
    const double ratio = rest_area(cloth) / area;
    if (ratio > k_suspicious_area_ratio || ratio < 1.0 / k_suspicious_area_ratio) {
        warn(fmt::format("cloth '{}': its uv pattern has {:.3g} times the area of its mesh; "
                         "uv_scale = {:.4g} would make them equal",
                         cloth.name, ratio, cloth.params.uv_scale / std::sqrt(ratio)));
    }
}

/// Mass at each vertex: of the fabric, or of the whole object where edges hold it together.
std::vector<double> vertex_masses(const Cloth& cloth) {
    const double density = cloth.params.model == Model::Corotational
                               ? cloth.params.fabric.area_density
                               : cloth.params.spring.mass / rest_area(cloth);
    std::vector<double> masses;
    for (const double area : cloth.rest_areas) {
        masses.push_back(density * area);
    }
    return masses;
}

void build_network(Cloth& cloth, std::span<const Index> polygons, const Warn& warn) {
    const ClothParams& params = cloth.params;
    if (params.model == Model::Corotational) {
        return;
    }
    cloth.network = cloth_network(cloth, polygons);
    if (const std::string text = softening_text(params.model, params.spring); !text.empty()) {
        warn(fmt::format("cloth '{}': {}; it snaps through there", cloth.name, text));
    }
    if (params.spring.calibrate && params.model != Model::StvkTriangle) {
        warn(fmt::format("cloth '{}': its calibrated edges differ from its fabric by {}",
                         cloth.name, calibration_error_text(cloth)));
    }
}

} // namespace

Cloth&
add_cloth(World& world, const ClothParams& params, const ImportedMesh& imported, const Warn& warn) {
    Cloth cloth;
    cloth.name = params.name;
    cloth.params = params;
    cloth.first_vertex = static_cast<Index>(world.positions.size());
    cloth.vertex_count = static_cast<Index>(imported.mesh.positions.size());
    cloth.triangles = imported.mesh.triangles;
    cloth.topology = build_edges(cloth.triangles);

    std::vector<Vec3> positions = imported.mesh.positions;
    for (Vec3& x : positions) {
        x *= params.placement.scale; // the rest shape is scaled; turning it would turn the grain
    }
    build_rest_shape(cloth, positions, imported.corner_uv);
    cloth.rest_areas = mixed_rest_areas(cloth);
    if (params.rest == RestShape::Uv) {
        warn_of_uv_units(cloth, positions, warn);
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        world.positions.push_back(place(params.placement, imported.mesh.positions[i]));
        world.velocities.push_back(params.velocity);
    }
    const std::vector<double> masses = vertex_masses(cloth);
    world.masses.insert(world.masses.end(), masses.begin(), masses.end());
    build_network(cloth, imported.polygons, warn);
    extend_history(world);
    return world.cloths.emplace_back(std::move(cloth));
}

} // namespace weft
