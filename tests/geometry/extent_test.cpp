#include "geometry/extent.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {
namespace {

std::vector<Vec3> points_on_a_sphere(double radius, int count) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        points.push_back(radius *
                         Vec3(normal(random), normal(random), normal(random)).normalized());
    }
    return points;
}

TEST(Extent, HasTheExactBoxOfItsPoints) {
    Extent extent;
    Box3 box;
    for (const Vec3& x : points_on_a_sphere(2.0, 500)) {
        extent.extend(x);
        box.extend(x);
    }

    EXPECT_TRUE(extent.box().isApprox(box, 0.0));
    EXPECT_TRUE(Extent().box().isEmpty());
    EXPECT_TRUE(Extent(Box3()).is_empty());
}

TEST(Extent, FallsShortOfTheHullByLessThanFourPercentOfTheRadius) {
    Extent extent;
    const std::vector<Vec3> points = points_on_a_sphere(1.0, 20000);
    for (const Vec3& x : points) {
        extent.extend(x);
    }

    for (const Vec3& direction : points_on_a_sphere(1.0, 1000)) {
        double reach = 0.0;
        for (const Vec3& x : extent.points()) {
            reach = std::max(reach, direction.dot(x));
        }
        EXPECT_GT(reach, 0.96); // 128 directions leave 10 degrees between, cos 16 degrees = 0.96
    }
}

TEST(Extent, TellsHowFarItReachesBeyondAnother) {
    const Extent small(Box3(Vec3(0, 0, 0), Vec3(1, 1, 1)));
    Extent large = small;
    large.extend(Vec3(0.5, -0.25, 0.5));
    large.extend(Vec3(1.5, 0.5, 0.5));

    EXPECT_NEAR(large.excess_over(small), 0.5, 1e-12);
    EXPECT_NEAR(large.excess_below(small), 0.25, 1e-12);
    EXPECT_LE(small.excess_over(large), 0.0);
}

} // namespace
} // namespace weft
