#include "geometry/triangle_mesh.h"
#include "geometry/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {

namespace {

double total_area(const std::vector<Vec3>& corners, const std::vector<Triangle>& triangles) {
    double area = 0.0;
    for (const Triangle& t : triangles) {
        area += triangle_area(corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]);
    }
    return area;
}

} // namespace

TEST(Triangulate, SquareIsCutFromItsFirstCorner) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

    EXPECT_EQ(triangulate_polygon(square), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, QuadIsCutAlongItsShorterDiagonal) {
    const std::vector<Vec3> kite{{-2, 0, 0}, {0, -1, 0}, {2, 0, 0}, {0, 1, 0}};

    EXPECT_EQ(triangulate_polygon(kite), (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Triangulate, DentedQuadIsNotCutOutsideItself) {
    // An arrow head with the dent at corner 2; the diagonal 1-3 runs outside and is the shorter
    // one.
    const std::vector<Vec3> arrow{{0, -3, 0}, {1, 1, 0}, {0, 0, 0}, {-1, 1, 0}};

    EXPECT_EQ(triangulate_polygon(arrow), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, StarIsCoveredOnceWithItsOwnWinding) {
    std::vector<Vec3> star; // ten corners, radius 2 and 1 in turn, in a tilted plane
    const Vec3 u = Vec3(1, 2, -1).normalized();
    const Vec3 v = u.unitOrthogonal();
    for (int i = 0; i < 10; ++i) {
        const double angle = 2.0 * M_PI * i / 10.0;
        const double radius = i % 2 == 0 ? 2.0 : 1.0;
        star.emplace_back(radius * (std::cos(angle) * u + std::sin(angle) * v));
    }

    const std::vector<Triangle> triangles = triangulate_polygon(star);

    ASSERT_EQ(triangles.size(), 8U);
    // Ten triangles from the centre, each of area (1/2) 2 * 1 * sin 36 degrees.
    EXPECT_NEAR(total_area(star, triangles), 10.0 * std::sin(M_PI / 5.0), 1e-12);
    for (const Triangle& t : triangles) {
        const Vec3 normal = triangle_normal(star[at(t[0])], star[at(t[1])], star[at(t[2])]);
        EXPECT_GT(normal.dot(u.cross(v)), 0.99);
    }
}

TEST(Triangulate, PolygonWithoutAreaStillYieldsItsTriangles) {
    const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};

    EXPECT_EQ(triangulate_polygon(line).size(), 3U);
    EXPECT_TRUE(triangulate_polygon(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).empty());
}

} // namespace weft
