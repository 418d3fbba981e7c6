#include "step/contact_newton.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {

namespace {

constexpr double k_dt = 0.01;
constexpr double k_mass = 2e-3;
constexpr double k_gravity = 9.81;
constexpr double k_friction = 0.3;

/// A grain at the contact thickness over a plane, and what acts on it for a substep: gravity turned
/// by `angle` from the plane's normal.
struct Grain {
    std::vector<Vec3> start{Vec3::Zero()};
    std::vector<Vec3> x = start;
    std::vector<Vec3> v{Vec3::Zero()};
    std::vector<Vec3> residual;
    BlockMatrix matrix = make_pattern(1, {});
    std::vector<Index> rows{0};
    std::vector<char> held{0};
    std::vector<Contact> contacts{{.pair = {0, 1, 2, 3},
                                   .kind = PairKind::VertexFace,
                                   .vertices = {0, k_no_index, k_no_index, k_no_index},
                                   .weights = {1.0, -0.2, -0.3, -0.5},
                                   .normal = Vec3::UnitY(),
                                   .gap = 1e-3,
                                   .thickness = 1e-3,
                                   .rest_gap = 1e-3,
                                   .barrier_width = 7e-4,
                                   .mass = k_mass,
                                   .friction = k_friction,
                                   .static_friction = k_friction,
                                   .obstacle_displacement = Vec3::Zero()}};
    ContactForces forces{std::vector<double>(1, 1000.0)};
    BalanceReport report;

    explicit Grain(double angle) {
        residual = {k_dt * k_mass * k_gravity * Vec3(std::sin(angle), -std::cos(angle), 0.0)};
        matrix.blocks[0] = k_mass * Mat3::Identity();
        forces.start(start, k_dt);
        forces.take(contacts);
        ContactNewton newton;
        report = newton.solve({&matrix, rows, held, k_dt, 1e-12, residual, x, v}, forces);
    }
};

} // namespace

TEST(ContactNewton, HoldsAGrainBelowTheFrictionAngle) {
    const Grain grain(std::atan(k_friction) - 0.01);

    EXPECT_LE(grain.report.imbalance, 1e-12);
    EXPECT_LT(grain.x[0].norm(), 3e-5); // weight over stiffness: 20 micrometres down
    EXPECT_LT(grain.x[0].x(), 6e-6);    // and its friction's spring
}

TEST(ContactNewton, LetsAGrainSlideAboveItAsCoulombSays) {
    const double angle = std::atan(k_friction) + 0.05;

    const Grain grain(angle);

    // The plane carries what does not move the grain into it.
    const double load = k_mass * (k_gravity * std::cos(angle) + grain.v[0].y() / k_dt);
    const double expected = k_dt * (k_gravity * std::sin(angle) - k_friction * load / k_mass);
    EXPECT_LE(grain.report.imbalance, 1e-12);
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(grain.v[0].x(), expected, 1e-6 * expected);
}

TEST(ContactNewton, LeavesAGrainThatLiftsOffToItself) {
    const Grain grain(2.0); // gravity points away from the plane

    EXPECT_LT((grain.v[0] - k_dt * k_gravity * Vec3(std::sin(2.0), -std::cos(2.0), 0.0)).norm(),
              1e-9);
}

} // namespace weft
