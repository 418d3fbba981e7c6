#include "geometry/curvature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace weft {

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
                mesh.positions.push_back((mesh.positions[static_cast<std::size_t>(a)] +
                                          mesh.positions[static_cast<std::size_t>(b)])
                                             .normalized());
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
