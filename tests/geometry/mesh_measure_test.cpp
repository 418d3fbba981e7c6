#include "geometry/mesh_measure.h"
#include "support/random_rotation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {

namespace {

/// 2 x 1 x 1 m box; the top (z = 1) is left out when `open`.
TriangleMesh box(bool open) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back(2.0 * (i & 1), (i >> 1) & 1, (i >> 2) & 1);
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7},
                      {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    if (!open) {
        mesh.triangles.push_back({4, 5, 7});
        mesh.triangles.push_back({4, 7, 6});
    }
    return mesh;
}

} // namespace

TEST(MeshMeasure, AClosedBoxHasItsAreaAndVolume) {
    const MeshMeasure m = measure_mesh(box(false));

    EXPECT_TRUE(m.is_closed);
    EXPECT_NEAR(m.area, 10.0, 1e-12);
    EXPECT_NEAR(m.volume, 2.0, 1e-12);
    EXPECT_EQ(m.parts, 1);
    EXPECT_EQ(m.edges, 18U);
    EXPECT_DOUBLE_EQ(m.edge_min, 1.0);
    EXPECT_DOUBLE_EQ(m.edge_max, std::sqrt(5.0));
    EXPECT_DOUBLE_EQ(m.largest_dimension(), 2.0);
    // Halves of the 2 x 1 faces have the least angle, tan a = 1/2, and an altitude of 2 / sqrt 5;
    // halves of the 1 x 1 faces have 1 / sqrt 2.
    EXPECT_NEAR(m.least_angle, std::atan(0.5), 1e-12);
    EXPECT_NEAR(m.least_altitude, 1.0 / std::sqrt(2.0), 1e-12);
}

TEST(MeshMeasure, AnOpenBoxHasOneLoopAroundItsRim) {
    const MeshMeasure m = measure_mesh(box(true));

    EXPECT_FALSE(m.is_closed);
    EXPECT_EQ(m.volume, 0.0);
    ASSERT_EQ(m.loops.size(), 1U);
    EXPECT_EQ(m.loops[0].edges, 4U);
    EXPECT_NEAR(m.loops[0].length, 6.0, 1e-12);
}

TEST(MeshMeasure, ASeamIsAnInnerEdgeWhereUvJumps) {
    const std::vector<Triangle> square{{0, 1, 2}, {0, 2, 3}};
    const std::vector<std::array<Vec2, 3>> whole{{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)},
                                                 {Vec2(0, 0), Vec2(1, 1), Vec2(0, 1)}};
    std::vector<std::array<Vec2, 3>> cut = whole;
    for (Vec2& uv : cut[1]) {
        uv += Vec2(3, 0);
    }

    EXPECT_EQ(measure_uv(square, whole).seam_edges, 0U);
    EXPECT_EQ(measure_uv(square, whole).islands, 1);
    EXPECT_EQ(measure_uv(square, cut).seam_edges, 1U);
    EXPECT_EQ(measure_uv(square, cut).islands, 2);
}

namespace {

/// Box of edge lengths 2, 4, 6 with one corner in the origin, turned and moved.
TriangleMesh turned_box(const Mat3& R, const Vec3& centre) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 2.0 : -2.0,
                          (i & 4) != 0 ? 3.0 : -3.0);
        mesh.positions.push_back(R * corner + centre);
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

} // namespace

TEST(MassMoments, OfABoxAreThoseOfTheFormula) {
    std::mt19937 random(1);
    const Mat3 R = test::random_rotation(random);
    const Vec3 centre(5.0, -7.0, 11.0);

    const MassMoments moments = mass_moments(turned_box(R, centre));

    // mean of x^2 over an edge of length a: a^2 / 12
    const Mat3 second = R * Vec3(4.0 / 12.0, 16.0 / 12.0, 36.0 / 12.0).asDiagonal() * R.transpose();
    EXPECT_NEAR(moments.volume, 48.0, 1e-11);
    EXPECT_LT((moments.centre - centre).norm(), 1e-12);
    EXPECT_LT((moments.second - second).norm(), 1e-12);
}

TEST(MassMoments, AreTheSameInsideOutButForTheVolume) {
    TriangleMesh mesh = turned_box(Mat3::Identity(), Vec3(1.0, 2.0, 3.0));
    const MassMoments moments = mass_moments(mesh);
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }

    const MassMoments turned = mass_moments(mesh);

    EXPECT_NEAR(turned.volume, -moments.volume, 1e-12);
    EXPECT_LT((turned.centre - moments.centre).norm(), 1e-13);
    EXPECT_LT((turned.second - moments.second).norm(), 1e-13);
}

} // namespace weft
