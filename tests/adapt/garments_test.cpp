#include "adapt/make_refinement.h"
#include "state/world.h"
#include "support/mesh_history.h"
#include "support/paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

namespace {

Cloth adaptive_garment(const std::string& name, RestShape rest) {
    Scene scene;
    ClothParams params;
    params.name = name;
    params.mesh.file = test::source_path("assets/meshes/" + name + ".obj");
    params.rest = rest;
    scene.cloths.push_back(params);
    Cloth cloth = build_world(scene, [](const std::string&) {}).cloths[0];
    make_refinement(cloth);
    return cloth;
}

/// Degrees, of the rest shape.
double least_angle(const Cloth& cloth) {
    double greatest_cosine = -1.0;
    for (const RestTriangle& rest : cloth.rest) {
        const auto m = rest_corners(rest);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = m[(k + 1) % 3] - m[k];
            const Vec2 b = m[(k + 2) % 3] - m[k];
            greatest_cosine = std::max(greatest_cosine, a.dot(b) / (a.norm() * b.norm()));
        }
    }
    return std::acos(greatest_cosine) * 180.0 / std::numbers::pi;
}

struct Garment {
    const char* name;
    RestShape rest;
};

class Garments : public testing::TestWithParam<Garment> {};

} // namespace

TEST_P(Garments, AreRefinedAndComeBack) {
    const Cloth start = adaptive_garment(GetParam().name, GetParam().rest);
    test::MeshHistory history(start, 1, 4);

    history.run(4, 1000, 0.85);

    EXPECT_GT(history.cloth.triangles.size(), 2 * start.triangles.size());
    EXPECT_GT(least_angle(history.cloth), least_angle(start) / 4.0);
    history.coarsen_all();
    EXPECT_EQ(history.cloth.triangles, start.triangles);
    EXPECT_EQ(history.cloth.topology.triangle_edges, start.topology.triangle_edges);
    EXPECT_EQ(history.cloth.rest_areas, start.rest_areas);
}

INSTANTIATE_TEST_SUITE_P(Meshes,
                         Garments,
                         testing::Values(Garment{"skirt", RestShape::Mesh},
                                         Garment{"tshirt", RestShape::Mesh},
                                         Garment{"tshirt", RestShape::Uv},
                                         Garment{"plate_with_hole", RestShape::Mesh}),
                         [](const auto& test) {
                             return std::string(test.param.name) +
                                    (test.param.rest == RestShape::Uv ? "_uv" : "_mesh");
                         });

} // namespace weft
