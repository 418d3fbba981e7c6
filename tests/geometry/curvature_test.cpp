#include "geometry/curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
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

TEST(MixedAreas, EquilateralTriangleGivesAThirdToEachCorner) {
    const double area = std::sqrt(3.0) / 4.0;

    const auto areas = mixed_corner_areas({Vec2(0, 0), Vec2(1, 0), Vec2(0.5, std::sqrt(0.75))});

    for (const double corner_area : areas) {
        EXPECT_NEAR(corner_area, area / 3.0, 1e-15);
    }
}

TEST(MixedAreas, RightTriangleGivesHalfToTheRightAngle) {
    // The circumcentre lies on the hypotenuse: Voronoi and obtuse rule meet there.
    const auto areas = mixed_corner_areas({Vec2(0, 0), Vec2(2, 0), Vec2(0, 3)});

    EXPECT_NEAR(areas[0], 1.5, 1e-15);
    EXPECT_NEAR(areas[1], 0.75, 1e-15);
    EXPECT_NEAR(areas[2], 0.75, 1e-15);
}

TEST(MixedAreas, ObtuseCornerGetsHalf) {
    const auto areas = mixed_corner_areas(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.5, 0));

    EXPECT_NEAR(areas[0], 0.125, 1e-15);
    EXPECT_NEAR(areas[1], 0.125, 1e-15);
    EXPECT_NEAR(areas[2], 0.25, 1e-15);
}

TEST(MixedAreas, SharesSumToTheAreaOfAnyTriangle) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 x0(uniform(random), uniform(random), uniform(random));
        const Vec3 x1(uniform(random), uniform(random), uniform(random));
        const Vec3 x2(uniform(random), uniform(random), uniform(random));

        const auto areas = mixed_corner_areas(x0, x1, x2);

        const double area = triangle_area(x0, x1, x2);
        EXPECT_NEAR(areas[0] + areas[1] + areas[2], area, 1e-13 * area);
        EXPECT_GT(std::min({areas[0], areas[1], areas[2]}), 0.0);
    }
}

TEST(MixedAreas, CollapsedTriangleHasNone) {
    const auto areas = mixed_corner_areas(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0));

    for (const double area : areas) {
        EXPECT_EQ(area, 0.0);
    }
}

TEST(MixedAreas, VerticesOfASurfaceShareItsWholeArea) {
    const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.3, 0.2}};
    const std::vector<Triangle> triangles{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    double area = 0.0;
    for (const Triangle& t : triangles) {
        area += triangle_area(square[at(t[0])], square[at(t[1])], square[at(t[2])]);
    }

    const std::vector<double> areas = mixed_areas(square, triangles);

    double sum = 0.0;
    for (const double vertex_area : areas) {
        sum += vertex_area;
    }
    EXPECT_NEAR(sum, area, 1e-14);
}

namespace {

/// The octahedron, each triangle cut in four `levels` times, on the unit sphere.
TriangleMesh unit_sphere(int levels) {
    TriangleMesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<Index, Index>, Index> middles;
        const auto middle = [&](Index a, Index b) {
            const auto [it, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                         static_cast<Index>(mesh.positions.size()));
            if (fresh) {
                mesh.positions.push_back(
                    (mesh.positions[at(a)] + mesh.positions[at(b)]).normalized());
            }
            return it->second;
        };
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    return mesh;
}

/// A sheet of (n+1)^2 points under z = height(x), cut along one diagonal, x over [0, 1].
TriangleMesh bent_sheet(int n, double radius) {
    TriangleMesh mesh;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const double angle = static_cast<double>(i) / n / radius;
            mesh.positions.emplace_back(radius * std::sin(angle), static_cast<double>(j) / n,
                                        radius * (1.0 - std::cos(angle)));
        }
    }
    for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
            const Index a = j * (n + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    return mesh;
}

} // namespace

TEST(Curvature, UnitSphereHasMeanCurvatureOne) {
    const TriangleMesh sphere = unit_sphere(4);

    const auto normals = mean_curvature_normals(sphere.positions, sphere.triangles);
    const auto curvatures =
        mean_curvatures(sphere.positions, sphere.triangles, build_edges(sphere.triangles));

    for (std::size_t i = 0; i < curvatures.size(); ++i) {
        EXPECT_NEAR(curvatures[i], 1.0, 5e-3);
        EXPECT_GT(normals[i].dot(sphere.positions[i]), 1.99); // points outwards
    }
}

TEST(Curvature, CylinderHasHalfOfOneOverItsRadius) {
    const double radius = 0.7;
    const TriangleMesh sheet = bent_sheet(30, radius);

    const auto curvatures =
        mean_curvatures(sheet.positions, sheet.triangles, build_edges(sheet.triangles));

    for (const double curvature : curvatures) { // the boundary included
        EXPECT_NEAR(curvature, 0.5 / radius, 1e-3 / radius);
    }
}

TEST(Curvature, PlaneHasNone) {
    TriangleMesh sheet = bent_sheet(5, 1e12);
    for (Vec3& p : sheet.positions) {
        p.x() += 0.05 * std::sin(20.0 * p.y()); // irregular, still flat
        p.z() = 0.0;
    }

    for (const double curvature :
         mean_curvatures(sheet.positions, sheet.triangles, build_edges(sheet.triangles))) {
        EXPECT_NEAR(curvature, 0.0, 1e-12);
    }
}

TEST(Curvature, CollapsedTrianglesStayFinite) {
    const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};

    for (const double curvature : mean_curvatures(line, triangles, build_edges(triangles))) {
        EXPECT_TRUE(std::isfinite(curvature));
    }
}

} // namespace weft
