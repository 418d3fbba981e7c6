#include "geometry/distance.h"
#include "geometry/nearest_surface.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// A cube of side 2 about the origin, two triangles a face, normals outward.
TriangleMesh cube() {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

double distance_to_cube(const Vec3& p) {
    const Vec3 q = p.cwiseAbs() - Vec3::Ones();
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

} // namespace

TEST(NearestSurface, HasTheSignedDistanceOfACube) {
    const TriangleMesh mesh = cube();
    const NearestSurface surface(mesh.positions, mesh.triangles);
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> unit(-3.0, 3.0);

    for (int i = 0; i < 1000; ++i) {
        const Vec3 p(unit(engine), unit(engine), unit(engine));
        const auto found = surface.find(p, 10.0);

        ASSERT_TRUE(found);
        EXPECT_NEAR(found->height, distance_to_cube(p), 1e-12);
        EXPECT_LT((found->place + found->height * found->normal - p).norm(), 1e-12);
        EXPECT_FALSE(found->is_on_boundary);
    }
}

TEST(NearestSurface, FindsNothingBeyondItsReach) {
    const TriangleMesh mesh = cube();
    const NearestSurface surface(mesh.positions, mesh.triangles);

    EXPECT_FALSE(surface.find({0.0, 1.6, 0.0}, 0.5));
    EXPECT_TRUE(surface.find({0.0, 1.4, 0.0}, 0.5));
}

TEST(NearestSurface, OnTheSurfaceStillKnowsItsOuterSide) {
    const TriangleMesh mesh = cube();
    const NearestSurface surface(mesh.positions, mesh.triangles);

    EXPECT_TRUE(surface.find({0.2, 1.0, 0.3}, 1.0)->normal.isApprox(Vec3::UnitY()));
    EXPECT_TRUE(surface.find({1.0, 1.0, 1.0}, 1.0)->normal.isApprox(Vec3::Ones().normalized()));
}

TEST(NearestSurface, OfAnOpenSheetTellsItsRimAndLeavesOutTrianglesWithoutArea) {
    const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0.5, 0, 0}};
    const std::vector<Triangle> triangles{{0, 4, 1}, {0, 2, 1}, {0, 3, 2}};
    const NearestSurface surface(x, triangles);

    EXPECT_TRUE(surface.find({-0.2, 0.1, 0.5}, 1.0)->is_on_boundary);
    EXPECT_FALSE(surface.find({0.5, 0.1, 0.5}, 1.0)->is_on_boundary);
    EXPECT_NEAR(surface.find({0.3, -0.2, 0.5}, 1.0)->height, -0.2, 1e-15);
}

TEST(NearestSurface, FirstHitIsWhereARayLeavesTheBody) {
    const TriangleMesh mesh = cube();
    const NearestSurface surface(mesh.positions, mesh.triangles);

    EXPECT_NEAR(*surface.first_hit({0.3, 1.0, 0.2}, -Vec3::UnitY(), 5.0), 2.0, 1e-12);
    EXPECT_NEAR(*surface.first_hit({0.3, 0.1, 0.2}, Vec3::UnitX(), 5.0), 0.7, 1e-12);
    EXPECT_NEAR(*surface.first_hit(Vec3::Ones(), -Vec3::Ones().normalized(), 5.0),
                2.0 * std::sqrt(3.0), 1e-9);
    EXPECT_FALSE(surface.first_hit({0.3, 0.1, 0.2}, Vec3::UnitX(), 0.5));
    EXPECT_FALSE(surface.first_hit({0.3, 1.5, 0.2}, Vec3::UnitY(), 5.0));
}

} // namespace weft
