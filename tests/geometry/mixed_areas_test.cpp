#include "geometry/mixed_areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace weft {

TEST(MixedAreas, EquilateralTriangleGivesAThirdToEachCorner) {
    const double area = std::sqrt(3.0) / 4.0;

    const auto shares = mixed_corner_areas({Vec2(0, 0), Vec2(1, 0), Vec2(0.5, std::sqrt(0.75))});

    for (const double share : shares) {
        EXPECT_NEAR(share, area / 3.0, 1e-15);
    }
}

TEST(MixedAreas, RightTriangleGivesHalfToTheRightAngle) {
    // The circumcentre lies on the hypotenuse: Voronoi and obtuse rule meet there.
    const auto shares = mixed_corner_areas({Vec2(0, 0), Vec2(2, 0), Vec2(0, 3)});

    EXPECT_NEAR(shares[0], 1.5, 1e-15);
    EXPECT_NEAR(shares[1], 0.75, 1e-15);
    EXPECT_NEAR(shares[2], 0.75, 1e-15);
}

TEST(MixedAreas, ObtuseCornerGetsHalf) {
    const auto shares = mixed_corner_areas(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.5, 0));

    EXPECT_NEAR(shares[0], 0.125, 1e-15);
    EXPECT_NEAR(shares[1], 0.125, 1e-15);
    EXPECT_NEAR(shares[2], 0.25, 1e-15);
}

TEST(MixedAreas, SharesSumToTheAreaOfAnyTriangle) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 x0(uniform(random), uniform(random), uniform(random));
        const Vec3 x1(uniform(random), uniform(random), uniform(random));
        const Vec3 x2(uniform(random), uniform(random), uniform(random));

        const auto shares = mixed_corner_areas(x0, x1, x2);

        const double area = triangle_area(x0, x1, x2);
        EXPECT_NEAR(shares[0] + shares[1] + shares[2], area, 1e-13 * area);
        EXPECT_GT(std::min({shares[0], shares[1], shares[2]}), 0.0);
    }
}

TEST(MixedAreas, CollapsedTriangleHasNone) {
    const auto shares = mixed_corner_areas(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0));

    for (const double share : shares) {
        EXPECT_EQ(share, 0.0);
    }
}

TEST(MixedAreas, VerticesOfASurfaceShareItsWholeArea) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.3, 0.2}};
    const std::vector<Triangle> triangles{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    double area = 0.0;
    for (const Triangle& t : triangles) {
        area += triangle_area(square[static_cast<std::size_t>(t[0])],
                              square[static_cast<std::size_t>(t[1])],
                              square[static_cast<std::size_t>(t[2])]);
    }

    const std::vector<double> areas = mixed_areas(square, triangles);

    double sum = 0.0;
    for (const double share : areas) {
        sum += share;
    }
    EXPECT_NEAR(sum, area, 1e-14);
}

} // namespace weft
