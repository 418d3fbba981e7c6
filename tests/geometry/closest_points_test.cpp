#include "geometry/closest_points.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

Vec3 at(const Vec3& w, const std::array<Vec3, 3>& x) {
    return w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
}

/// Nearest of a fine lattice of points on the triangle.
double slow_distance(const Vec3& p, const std::array<Vec3, 3>& x) {
    constexpr int n = 200;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            const Vec3 w(1.0 - (i + j) / double{n}, i / double{n}, j / double{n});
            nearest = std::min(nearest, (at(w, x) - p).norm());
        }
    }
    return nearest;
}

} // namespace

TEST(ClosestPoints, EachRegionOfATriangleGivesItsOwnWeights) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);

    EXPECT_LT(
        (closest_weights_on_triangle({0.25, 0.25, 3}, a, b, c) - Vec3(0.5, 0.25, 0.25)).norm(),
        1e-15);
    EXPECT_LT((closest_weights_on_triangle({-1, -1, 1}, a, b, c) - Vec3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LT((closest_weights_on_triangle({3, -1, 1}, a, b, c) - Vec3(0, 1, 0)).norm(), 1e-15);
    EXPECT_LT((closest_weights_on_triangle({0.5, -2, 1}, a, b, c) - Vec3(0.5, 0.5, 0)).norm(),
              1e-15);
    EXPECT_LT((closest_weights_on_triangle({1, 1, 1}, a, b, c) - Vec3(0, 0.5, 0.5)).norm(), 1e-15);
}

TEST(ClosestPoints, AreNeverFartherThanASlowSearchFinds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    const auto point = [&] {
        return Vec3(coordinate(random), coordinate(random), coordinate(random));
    };
    for (int i = 0; i < 200; ++i) {
        const std::array<Vec3, 3> x{point(), point(), point()};
        const Vec3 p = 2.0 * point();

        const Vec3 w = closest_weights_on_triangle(p, x[0], x[1], x[2]);

        const double distance = (at(w, x) - p).norm();
        EXPECT_LE(distance, slow_distance(p, x) + 1e-12);
        EXPECT_GE(w.minCoeff(), 0.0);
        EXPECT_NEAR(w.sum(), 1.0, 1e-14);
    }
}

TEST(ClosestPoints, TriangleWithoutAreaActsAsItsLongestEdge) {
    const Vec3 w = closest_weights_on_triangle({0.5, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0.25, 0, 0});

    EXPECT_NEAR(w[1] + 0.25 * w[2], 0.5, 1e-15);
}

} // namespace weft
