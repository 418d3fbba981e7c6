#include "forces/bending.h"
#include "support/derivatives.h"
#include "support/sheets.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

struct BentSheet {
    Sheet sheet = irregular_sheet(8, 6, 0.4, 0.3, 0.3, 3);
    BendDampingElements damping{cloth_of(sheet, {.bend_stiffness = 1e-4, .damping = {0.0, 0.02}})};
    std::vector<Vec3> x = placed(sheet, [](const Vec2& m) {
        return Vec3(m.x(), 0.05 * std::sin(20.0 * m.x() + 5.0 * m.y()), m.y());
    });
};

} // namespace

TEST(BendDamping, LeavesTheRotationOfABentSheetAlone) {
    const BentSheet s;
    std::vector<Vec3> v, f(4 * s.damping.size());
    for (const Vec3& p : s.x) {
        v.push_back(Vec3(1, 2, 3) + Vec3(2.0, -3.0, 1.0).cross(p));
    }

    s.damping.forces(s.x, v, f);

    // -tau Q v, the damping that is not objective, would give forces of the order of
    // tau D |w| / edge length = 1e-4 N.
    for (const Vec3& force : f) {
        EXPECT_LT(force.norm(), 1e-15);
    }
}

TEST(BendDamping, BrakesBendingWithoutForceOrTorque) {
    const BentSheet s;
    std::vector<Vec3> v, f(4 * s.damping.size());
    for (const Vec3& p : s.x) {
        v.push_back(Vec3(p.x() * p.y(), std::sin(30.0 * p.x()), p.x()));
    }

    s.damping.forces(s.x, v, f);

    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    double power = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (s.damping.nodes()[i] == k_no_index) {
            EXPECT_TRUE(f[i].isZero(0.0));
            continue;
        }
        const auto vertex = at(s.damping.nodes()[i]);
        sum += f[i];
        torque += s.x[vertex].cross(f[i]);
        power += f[i].dot(v[vertex]);
        scale += f[i].norm();
    }
    EXPECT_LT(sum.norm(), 1e-14 * scale);
    EXPECT_LT(torque.norm(), 1e-14 * scale);
    EXPECT_LT(power, -1e-3 * scale);
}

TEST(BendDamping, BlocksAreTheDerivativeByVelocityAndPositiveSemidefinite) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 20; ++i) {
        VecX x(12), v(12);
        for (int k = 0; k < 12; ++k) {
            x(k) = normal(random);
            v(k) = normal(random);
        }
        const double least_area = i % 2 == 0 ? 0.0 : 5.0; // also where the gradient is scaled
        const auto force = [&](const VecX& velocity) {
            return flat<4>(
                hinge_damping_terms(corners<4>(x), corners<4>(velocity), 0.3, least_area, {})
                    .force);
        };

        const MatX D = assembled<4>(
            hinge_damping_terms(corners<4>(x), corners<4>(v), 0.3, least_area, {0.0, 1.0})
                .stiffness);

        EXPECT_LT((D + numerical_jacobian(force, v, 1e-3)).norm(), 1e-8 * (1e-3 + D.norm()));
        const VecX values = eigenvalues(D);
        EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
    }
}

} // namespace weft
