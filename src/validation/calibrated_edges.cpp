#include "state/build_network.h"

#include <fmt/core.h>

#include "validation/experiments.h"
#include "validation/sheet_world.h"
#include "validation/statics.h"
#include "validation/uniaxial.h"

namespace weft {

namespace {

constexpr int k_cells = 8;

/// A unit square of edges calibrated to a fabric. Quads have both diagonals.
World calibrated_world(const Sheet& sheet, const FabricParams& fabric, bool has_quads) {
    ClothParams params;
    params.model = Model::Cubic;
    params.fabric = fabric;
    params.spring.calibrate = true;
    params.spring.bend = 0.0;
    World world = sheet_world(sheet, params);
    Cloth& cloth = world.cloths[0];
    std::vector<Index> polygons;
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        polygons.push_back(static_cast<Index>(has_quads ? t / 2 : t));
    }
    cloth.network = cloth_network(cloth, polygons);
    return world;
}

/// Shear modulus of the square whose border is sheared by 1, N/m.
double shear_test(const Sheet& sheet, const Eigen::SparseMatrix<double>& stiffness) {
    StaticLoad load(sheet.points.size());
    load.hold_all(2);
    for (const Index v : vertices_where(sheet, [](const Vec2& p) {
             return std::min({p.x(), p.y(), 1.0 - p.x(), 1.0 - p.y()}) < 1e-9;
         })) {
        load.hold(v, 0, sheet.points[static_cast<std::size_t>(v)].y());
        load.hold(v, 1, 0.0);
    }
    const Eigen::VectorXd u = linear_response(stiffness, load);
    return u.dot(stiffness * u); // twice the energy of a unit of area
}

} // namespace

/// How far edges calibrated to a fabric are from it as a whole: pulled along weft, and sheared.
/// Edges alone make c12 = c33, which fabrics need not have, so tolerances here are what is told of
/// the calibration, not round-off.
ValidationRows validate_calibrated_edges() {
    struct Case {
        const char* name;
        Pattern pattern;
        bool has_quads;
        double tolerance; ///< for a fabric that edges can be; for another 6 % more
    };
    ValidationRows rows;
    for (const Case& c : {Case{"quads", Pattern::UnionJack, true, 0.002},
                          Case{"one diagonal", Pattern::OneDiagonal, false, 0.25},
                          Case{"alternating diagonals", Pattern::UnionJack, false, 0.02},
                          Case{"irregular triangles", Pattern::Irregular, false, 0.2}}) {
        const Sheet sheet = make_sheet(c.pattern, k_cells, k_cells, 1.0, 1.0);
        const auto add = [&](const FabricParams& fabric, const char* kind, double tolerance) {
            const World world = calibrated_world(sheet, fabric, c.has_quads);
            const auto stiffness = stiffness_matrix(world, empty_space());
            rows.push_back({.what = fmt::format("Young's modulus of {}: {}", kind, c.name),
                            .unit = "N/m",
                            .theory = fabric.stretch_stiffness[0],
                            .measured = tensile_test(sheet, stiffness).modulus,
                            .tolerance = tolerance,
                            .note = "8 x 8 cells; calibrated edges"});
            rows.push_back({.what = fmt::format("shear modulus of {}: {}", kind, c.name),
                            .unit = "N/m",
                            .theory = fabric.shear_stiffness,
                            .measured = shear_test(sheet, stiffness),
                            .tolerance = tolerance,
                            .note = "8 x 8 cells; calibrated edges"});
        };
        add(isotropic_fabric(1000.0, 1.0 / 3.0), "a fabric that edges can be", c.tolerance);
        add(FabricParams{}, "the default fabric", c.tolerance + 0.06);
    }
    return rows;
}

} // namespace weft
