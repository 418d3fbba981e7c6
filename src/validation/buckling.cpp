#include "base/parallel.h"
#include "base/stopwatch.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <Eigen/Eigenvalues>
#include <fmt/core.h>

#include <array>
#include <cmath>

/// Loads at which a flat strip, clamped at one end and loaded in its own plane, leaves the plane:
/// K_b z = -lambda K_g z, with the bending stiffness K_b of the sheet without load and K_g its
/// change under the load.
namespace weft {

namespace {

constexpr double k_length = 0.2;           // m, from the clamp to the free end
constexpr double k_rigidity = 1e-5;        // N m
constexpr double k_membrane_ratio = 1e6;   // E h L^2 / D; higher: strains drown in round-off
constexpr double k_difference_step = 3e-5; // fraction of a cell

enum class Load { OwnWeightAlong, EndLoad, OwnWeightAcross };

struct Case {
    const char* what;
    Load load;
    double theory; ///< rho g L^3 / D, or P L^2 / (D w) of the end load
    Pattern pattern;
    int cells, cells_across;
    double tolerance;
};

/// The rows and columns of vertices that are free.
Eigen::MatrixXd free_part(const Eigen::MatrixXd& matrix, const Sheet& sheet) {
    const std::vector<Index> free =
        vertices_where(sheet, [](const Vec2& p) { return p.x() > 1e-9; });
    return matrix(free, free);
}

/// Critical load in the measure of Case::theory.
double critical_load(const Case& c) {
    const double width = k_length / (c.cells + 0.5) * c.cells_across; // square cells
    const ClampedStrip strip(c.pattern, c.cells, c.cells_across, k_length, width);
    const Sheet& sheet = strip.sheet;
    const double unit = k_rigidity / (k_length * k_length); // N/m: of the end load
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(k_membrane_ratio * unit, 0.0);
    cloth.fabric.bend_stiffness = k_rigidity;
    cloth.fabric.area_density = c.theory * unit / (k_length * k_earth_gravity);
    World world = sheet_world(sheet, cloth);
    const double step = k_difference_step * strip.cell;
    const Eigen::MatrixXd bending =
        free_part(transverse_stiffness(world, empty_space(), step), sheet);

    SceneParams scene = empty_space();
    StaticLoad load(world.vertex_count());
    load.hold_all(2);
    for (const Index v : strip.clamp()) {
        load.hold(v);
    }
    if (c.load == Load::EndLoad) {
        for (const Index v : strip.free_end()) {
            const double y = sheet.points[static_cast<std::size_t>(v)].y();
            const bool is_corner = y < 1e-9 || y > width - 1e-9;
            load.add(v, Vec3(-(is_corner ? 0.5 : 1.0) * c.theory * unit * strip.cell, 0.0, 0.0));
        }
    } else {
        scene.gravity[c.load == Load::OwnWeightAlong ? 0 : 1] = -k_earth_gravity;
    }
    settle(world, scene, load, {.tolerance = 1e-7});
    const Eigen::MatrixXd change =
        free_part(transverse_stiffness(world, empty_space(), step), sheet) - bending;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(-change, bending,
                                                                          Eigen::EigenvaluesOnly);
    return c.theory / modes.eigenvalues().maxCoeff();
}

/// Twist is where the patterns differ: the operator is exact for it on one diagonal only.
const char* twist_of(Pattern pattern) {
    return pattern == Pattern::OneDiagonal ? "exact"
           : pattern == Pattern::UnionJack ? "1.6 times too stiff"
                                           : "1.2 times too stiff";
}

} // namespace

ValidationRows validate_buckling() {
    constexpr double k_lateral = 18.18; // 12.854 sqrt(2), nu = 0
    std::vector<Case> cases;
    for (const Pattern pattern : k_patterns) {
        cases.push_back({"strip standing under its own weight: rho g L^3/D", Load::OwnWeightAlong,
                         7.8373, pattern, 40, 4, 0.02});
    }
    cases.push_back({"strip under an end load: P L^2/(D w)", Load::EndLoad, 2.4674,
                     Pattern::OneDiagonal, 40, 4, 0.02});
    for (const Pattern pattern : k_patterns) {
        cases.push_back(
            {"lateral: rho g L^3/D", Load::OwnWeightAcross, k_lateral, pattern, 120, 6, 0.1});
    }
    ValidationRows rows(cases.size());
    parallel_for(
        cases.size(),
        [&](std::size_t i) {
            const Case& c = cases[i];
            const Stopwatch watch;
            rows[i] = {.what = fmt::format("{}: {}", c.what, name_of(c.pattern)),
                       .theory = c.theory,
                       .measured = critical_load(c),
                       .tolerance = c.tolerance,
                       .note = fmt::format("{} x {} cells; mid-edge bending; in twist {}", c.cells,
                                           c.cells_across, twist_of(c.pattern))};
            rows[i].seconds = watch.seconds();
        },
        1);
    return rows;
}

} // namespace weft
