#include "base/parallel.h"
#include "base/stopwatch.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

#include "validation/clamped_strip.h"
#include "validation/experiments.h"
#include "validation/sheet_world.h"
#include "validation/statics.h"

/// The heavy elastica: a strip clamped horizontally at one end that bends under its own weight.
/// Gamma = rho g L^3 / D says how heavy it is for its rigidity; H/W is drop over reach of the tip.
namespace weft {

namespace {

constexpr double k_length = 0.2;   // m, from the clamp to the tip
constexpr double k_gravity = 9.81; // m/s^2
constexpr double k_density = 0.15; // kg/m^2

/// E h L^2 / D, and the softer membranes with which the settling begins: a stiff one would let it
/// move in small steps only.
constexpr std::array k_membrane_ratios{1e4, 1e6, 1e8};

struct Case {
    double gamma;
    int cells; ///< along the strip
    Pattern pattern;
    BendModel model;
    double width;     ///< m
    double tolerance; ///< relative
};

/// Solutions of theta'' = -Gamma (1 - s) cos theta, theta(0) = 0, theta'(1) = 0.
double drop_over_reach(double gamma) {
    for (const auto& [at, value] : {std::pair{0.1, 0.012500},
                                    {1.0, 0.124562},
                                    {10.0, 1.066802},
                                    {100.0, 5.888105},
                                    {1000.0, 21.335441}}) {
        if (at == gamma) {
            return value;
        }
    }
    return 0.0;
}

double measured_drop_over_reach(const Case& c) {
    const ClampedStrip strip(c.pattern, c.cells, square_cells_across(c.cells, k_length, c.width),
                             k_length, c.width);
    const double rigidity = k_density * k_gravity * std::pow(k_length, 3) / c.gamma;
    ClothParams cloth;
    cloth.bend_model = c.model;
    SceneParams scene = empty_space();
    scene.gravity = Vec3(0.0, -k_gravity, 0.0);
    std::vector<Vec3> positions;
    for (const double ratio : k_membrane_ratios) {
        cloth.fabric = isotropic_fabric(ratio * rigidity / (k_length * k_length), 0.0);
        cloth.fabric.bend_stiffness = rigidity;
        cloth.fabric.area_density = k_density;
        World world =
            sheet_world(strip.sheet, cloth, [](const Vec2& p) { return Vec3(p.x(), 0, -p.y()); });
        StaticLoad load(world.vertex_count());
        for (const Index v : strip.clamp()) {
            load.hold(v);
        }
        if (!positions.empty()) {
            world.positions = positions;
        }
        settle(world, scene, load, {.tolerance = 1e-6});
        positions = world.positions;
    }
    Vec2 tip = Vec2::Zero(); // sums cancel in the quotient
    for (const Index v : strip.free_end()) {
        const Vec3& x = positions[static_cast<std::size_t>(v)];
        tip += Vec2(x.x() + 0.5 * strip.cell, -x.y());
    }
    return tip.y() / tip.x();
}

ValidationRows measure(const std::vector<Case>& cases) {
    ValidationRows rows(cases.size());
    parallel_for(
        cases.size(),
        [&](std::size_t i) {
            const Case& c = cases[i];
            const Stopwatch watch;
            rows[i] = {.what = fmt::format("H/W at Gamma = {:g}: {}: n = {}", c.gamma,
                                           name_of(c.pattern), c.cells),
                       .theory = drop_over_reach(c.gamma),
                       .measured = measured_drop_over_reach(c),
                       .tolerance = c.tolerance,
                       .note = fmt::format("{} bending; width {:g} L; E h L^2/D = 1e8",
                                           c.model == BendModel::MidEdge
                                               ? "mid-edge"
                                               : "quadratic (not the default)",
                                           c.width / k_length)};
            rows[i].seconds = watch.seconds();
        },
        1);
    return rows;
}

} // namespace

ValidationRows validate_cantilever() {
    std::vector<Case> cases;
    for (const Pattern pattern : k_patterns) {
        for (const double gamma : {0.1, 1.0, 10.0, 100.0}) {
            for (const int cells : {20, 40}) {
                cases.push_back({gamma, cells, pattern, BendModel::MidEdge, 0.1 * k_length, 0.02});
            }
        }
        // all bending is within L / sqrt(Gamma) of the clamp
        cases.push_back({1000.0, 160, pattern, BendModel::MidEdge, 0.1 * k_length, 0.02});
    }
    return measure(cases);
}

/// The quadratic hinge model has the bending Poisson ratio -1/3 and its own rigidity for each
/// pattern; a wide strip hides the first.
ValidationRows validate_cantilever_quadratic() {
    std::vector<Case> cases;
    for (const Pattern pattern : k_patterns) {
        const double tolerance = pattern == Pattern::OneDiagonal ? 0.15 : 0.05;
        for (const auto& [gamma, cells] :
             {std::pair{0.1, 20}, {1.0, 20}, {10.0, 20}, {10.0, 40}, {100.0, 20}, {1000.0, 40}}) {
            cases.push_back(
                {gamma, cells, pattern, BendModel::Quadratic, 0.5 * k_length, tolerance});
        }
    }
    return measure(cases);
}

} // namespace weft
