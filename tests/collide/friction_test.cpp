#include "collide/friction.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

constexpr FrictionLaw k_hold{.stiffness = 800.0, .limit = 0.02}; // slides from 25 micrometres on

std::vector<Vec3> displacements() {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::vector<Vec3> result{Vec3::Zero(), Vec3(1e-9, 0.0, 0.0), Vec3(0.0, 2.4999e-5, 0.0),
                             Vec3(0.0, 2.5001e-5, 0.0)};
    for (const double length : {1e-6, 2e-5, 3e-5, 1e-3, 0.1}) {
        result.push_back(length * Vec3(normal(random), normal(random), normal(random)));
    }
    return result;
}

} // namespace

TEST(FrictionLaw, ForceIsTheSlopeOfItsEnergyAndTangentThatOfItsForce) {
    for (const Vec3& u : displacements()) {
        const double step = std::max(1e-10, 1e-6 * u.norm());
        const Mat3 tangent = k_hold.tangent(u);
        const bool at_the_limit = std::abs(k_hold.stiffness * u.norm() - k_hold.limit) < 1e-4;
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Vec3 d = step * Vec3::Unit(k);
            const double slope = (k_hold.energy(u + d) - k_hold.energy(u - d)) / (2.0 * step);
            EXPECT_NEAR(k_hold.force(u)[k], -slope, 1e-4 * k_hold.limit) << u.transpose();
            if (!at_the_limit) { // where the tangent jumps
                const Vec3 change = (k_hold.force(u + d) - k_hold.force(u - d)) / (2.0 * step);
                EXPECT_LT((tangent.col(k) + change).norm(), 1e-4 * (1.0 + change.norm()));
            }
        }
    }
}

TEST(FrictionLaw, DampedTangentLiesAboveTheEnergyEverywhere) {
    for (const Vec3& u : displacements()) {
        const Mat3 above = k_hold.damped_tangent(u, 1.0);
        EXPECT_LT((k_hold.damped_tangent(u, 0.0) - k_hold.tangent(u)).norm(), 1e-12);
        for (const Vec3& w : displacements()) {
            const Vec3 d = w - u;
            const double bound = k_hold.energy(u) - k_hold.force(u).dot(d) + 0.5 * d.dot(above * d);
            EXPECT_LE(k_hold.energy(w), bound * (1.0 + 1e-12) + 1e-15);
        }
    }
}

TEST(FrictionLaw, HoldsUpToItsLimitAndKeepsWhatHasNotSlidOff) {
    for (const Vec3& u : displacements()) {
        EXPECT_LE(k_hold.force(u).norm(), k_hold.limit * (1.0 + 1e-12));
        EXPECT_LT((k_hold.force(k_hold.kept(u)) - k_hold.force(u)).norm(), 1e-12);
        EXPECT_FALSE(FrictionLaw({800.0, 0.020001}).slides(k_hold.kept(u)));
    }
}

} // namespace weft
