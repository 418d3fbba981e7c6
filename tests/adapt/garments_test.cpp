#include "adapt/adaptive_cloth.h"
#include "adapt/rest_split.h"
#include "state/build_world.h"
#include "state/world.h"
#include "support/mesh_history.h"
#include "support/paths.h"

#include <gtest/gtest.h>

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
    EXPECT_GE(least_rest_angle(history.cloth), least_refined_angle(start, 4) - 1e-9);
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
