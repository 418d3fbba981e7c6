#include "geometry/dihedral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace weft {

TEST(DihedralAngle, IsNegativeWhenTheApexesRiseAlongTheNormal) {
    for (const double angle : {-2.5, -1.0, 0.0, 0.3, 3.0}) {
        // edge along y; both normals +z when flat; each apex lowered by half the angle
        const Vec3 x2(-std::cos(angle / 2), 0.3, -std::sin(angle / 2));
        const Vec3 x3(std::cos(angle / 2), 0.6, -std::sin(angle / 2));

        EXPECT_NEAR(dihedral_angle({0, 0, 0}, {0, 1, 0}, x2, x3), angle, 1e-14);
    }
}

TEST(DihedralAngle, GradientAgreesWithDifferences) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 100; ++i) {
        std::array<Vec3, 4> x;
        for (Vec3& p : x) {
            p = Vec3(normal(random), normal(random), normal(random));
        }
        if (std::abs(dihedral_angle(x[0], x[1], x[2], x[3])) > 3.0) {
            continue; // the angle jumps at pi
        }

        const auto gradient = dihedral_gradient(x[0], x[1], x[2], x[3]);

        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        for (std::size_t a = 0; a < 4; ++a) {
            sum += gradient[a];
            torque += x[a].cross(gradient[a]);
            for (int axis = 0; axis < 3; ++axis) {
                auto above = x, below = x;
                const double delta = 1e-6;
                above[a](axis) += delta;
                below[a](axis) -= delta;
                const double expected = (dihedral_angle(above[0], above[1], above[2], above[3]) -
                                         dihedral_angle(below[0], below[1], below[2], below[3])) /
                                        (2 * delta);
                EXPECT_NEAR(gradient[a](axis), expected, 1e-5 * (1.0 + gradient[a].squaredNorm()));
            }
        }
        const double scale = gradient[2].norm() + gradient[3].norm();
        EXPECT_LT(sum.norm(), 1e-13 * scale);
        EXPECT_LT(torque.norm(), 1e-12 * scale);
    }
}

TEST(DihedralAngle, CollapsedTrianglesHaveNoGradient) {
    const auto gradient = dihedral_gradient({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0});

    for (const Vec3& g : gradient) {
        EXPECT_EQ(g, Vec3::Zero());
    }
    EXPECT_EQ(dihedral_angle({0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {0, 1, 0}), 0.0);
}

} // namespace weft
