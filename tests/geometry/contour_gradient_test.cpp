#include "geometry/contour_gradient.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// Where the line through a and b meets the plane y = 0.
Vec3 foot(const Vec3& a, const Vec3& b) {
    return a + a.y() / (a.y() - b.y()) * (b - a);
}

} // namespace

TEST(ContourGradient, OfAFlapThroughAFloorPointsBackOut) {
    // an edge stands upright in the floor, its triangle reaches along x: the way out is along x
    const std::vector<Vec3> apex{{1.0, 0.0, 0.0}};

    const auto gradient = contour_gradient({0, -1, 0}, {0, 1, 0}, apex, Vec3::UnitY());

    ASSERT_TRUE(gradient);
    EXPECT_TRUE(gradient->isApprox(Vec3::UnitX(), 1e-12)) << gradient->transpose();
}

TEST(ContourGradient, OfTwoTrianglesThatPullEvenlyIsNone) {
    const std::vector<Vec3> apexes{{1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};

    EXPECT_FALSE(contour_gradient({0, -1, 0}, {0, 1, 0}, apexes, Vec3::UnitY()));
}

TEST(ContourGradient, TakesTheEdgesFootTowardsTheContoursOtherEnd) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);

    for (int i = 0; i < 300; ++i) {
        const Vec3 p(unit(engine), -0.2 - std::abs(unit(engine)), unit(engine));
        const Vec3 q(unit(engine), 0.2 + std::abs(unit(engine)), unit(engine));
        const Vec3 apex(unit(engine), 3.0 + unit(engine), unit(engine));
        const Vec3 contour = foot(p, apex) - foot(p, q); // the side (p, apex) pierces as well

        const auto g = contour_gradient(p, q, std::vector<Vec3>{apex}, Vec3::UnitY());

        ASSERT_TRUE(g);
        const double step = 1e-6;
        const Vec3 way = foot(p + step * *g, q + step * *g) - foot(p, q);
        EXPECT_GT(way.dot(contour), 0.0) << i;
    }
}

} // namespace weft
