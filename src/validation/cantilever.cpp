#include "base/parallel.h"
#include "base/stopwatch.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

/// The heavy elastica: a strip clamped horizontally at one end that bends under its own weight.
/// Gamma = rho g L^3 / D says how heavy it is for its rigidity; H/W is drop over reach of the tip.
namespace weft {

namespace {

constexpr double k_length = 0.2;   // m, from the clamp to the tip
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

/// Drop over reach of the tip. With delta = pi/2 - theta and r = 1 - s the elastica is
///
///     delta'' = Gamma r sin delta,   delta'(0) = 0,   delta(1) = pi/2
///
/// Integrated from the tip (r = 0), delta at the clamp grows with delta at the tip, which bisection
/// of its logarithm finds. Fourth-order Runge-Kutta in 1000 steps: nine digits for Gamma <= 1000.
class Elastica {
public:
    explicit Elastica(double gamma) : gamma_(gamma) {
        double low = -60.0; // delta at the clamp is below pi/2 for any Gamma here
        double high = std::log(k_level);
        for (int i = 0; i < 70; ++i) {
            const double middle = 0.5 * (low + high);
            (shoot(std::exp(middle)) > k_level ? high : low) = middle;
        }
        shoot(std::exp(low));
    }

    double drop_over_reach() const { return drop_ / reach_; }

private:
    static constexpr double k_level = 0.5 * std::numbers::pi;
    static constexpr int k_steps = 1000;

    /// delta at the clamp for one at the tip; any value above pi/2 where it gets there sooner.
    double shoot(double delta) {
        const double h = 1.0 / k_steps;
        double rate = 0.0; // delta'
        drop_ = reach_ = 0.0;
        for (int i = 0; i < k_steps && delta <= k_level; ++i) {
            const double r = i * h;
            const double a1 = second(r, delta);
            const double a2 = second(r + h / 2, delta + h / 2 * rate);
            const double a3 = second(r + h / 2, delta + h / 2 * rate + h * h / 4 * a1);
            const double a4 = second(r + h, delta + h * rate + h * h / 2 * a2);
            const double next = delta + h * rate + h * h / 6 * (a1 + a2 + a3);
            const double next_rate = rate + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
            const double middle = 0.5 * (delta + next) + h / 8 * (rate - next_rate);
            drop_ += h / 6 * (std::cos(delta) + 4 * std::cos(middle) + std::cos(next));
            reach_ += h / 6 * (std::sin(delta) + 4 * std::sin(middle) + std::sin(next));
            delta = next;
            rate = next_rate;
        }
        return delta;
    }

    double second(double r, double delta) const { return gamma_ * r * std::sin(delta); }

    double gamma_;
    double drop_ = 0.0, reach_ = 0.0; ///< fractions of the length
};

double measured_drop_over_reach(const Case& c) {
    const ClampedStrip strip(c.pattern, c.cells, square_cells_across(c.cells, k_length, c.width),
                             k_length, c.width);
    const double rigidity = k_density * k_earth_gravity * std::pow(k_length, 3) / c.gamma;
    ClothParams cloth;
    cloth.bend_model = c.model;
    SceneParams scene = empty_space();
    scene.gravity = Vec3(0.0, -k_earth_gravity, 0.0);
    std::vector<Vec3> positions;
    for (const double ratio : k_membrane_ratios) {
        cloth.fabric = isotropic_membrane(ratio * rigidity / (k_length * k_length), 0.0);
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
                       .theory = Elastica(c.gamma).drop_over_reach(),
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
