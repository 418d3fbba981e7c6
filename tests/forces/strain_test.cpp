#include "forces/membrane.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {

namespace {

const RestTriangle k_rest{Mat2::Identity(), 0.5};
const MembraneStiffness k_stiffness = membrane_stiffness(
    {.stretch_stiffness = {1000.0, 400.0}, .shear_stiffness = 50.0, .poisson = 0.0});

/// Corners of a triangle whose weft and warp become the given vectors.
Corners from_yarns(const Vec3& weft, const Vec3& warp) {
    return {Vec3(1, 2, 3), Vec3(Vec3(1, 2, 3) + weft), Vec3(Vec3(1, 2, 3) + warp)};
}

} // namespace

TEST(Strain, StretchAlongWeftIsSeenThereAlone) {
    const auto m = strain_measures(from_yarns({0, 1.25, 0}, {0, 0, 1}), k_rest, k_stiffness);

    EXPECT_NEAR(m.stretch_max, 1.25, 1e-14);
    EXPECT_NEAR(m.stretch_min, 1.0, 1e-14);
    EXPECT_NEAR(m.strain_weft, 0.25, 1e-14);
    EXPECT_NEAR(m.strain_warp, 0.0, 1e-14);
    EXPECT_NEAR(m.shear_deg, 0.0, 1e-12);
    EXPECT_NEAR(m.tension, 1000.0 * 0.25, 1e-10);
}

TEST(Strain, ShearIsTheLossOfTheRightAngle) {
    // yarns keep their length and meet at 70 degrees: stretches are sqrt(2) cos, sin of 35 degrees
    const double angle = 70.0 * M_PI / 180.0;

    const auto m = strain_measures(from_yarns({1, 0, 0}, {std::cos(angle), std::sin(angle), 0}),
                                   k_rest, k_stiffness);

    EXPECT_NEAR(m.shear_deg, 20.0, 1e-12);
    EXPECT_NEAR(m.strain_weft, 0.0, 1e-14);
    EXPECT_NEAR(m.strain_warp, 0.0, 1e-14);
    EXPECT_NEAR(m.stretch_max, std::sqrt(2.0) * std::cos(angle / 2), 1e-14);
    EXPECT_NEAR(m.stretch_min, std::sqrt(2.0) * std::sin(angle / 2), 1e-14);
}

TEST(Strain, OfACollapsedTriangleIsFinite) {
    const auto m = strain_measures(from_yarns(Vec3::Zero(), Vec3::Zero()), k_rest, k_stiffness);

    EXPECT_EQ(m.stretch_max, 0.0);
    EXPECT_EQ(m.stretch_min, 0.0);
    EXPECT_EQ(m.shear_deg, 0.0);
    EXPECT_NEAR(m.tension, -400.0, 1e-10); // both compressed by 100 %; the softer one is greater
}

} // namespace weft
