#include "scene/scene_reader.h"
#include "state/build_world.h"
#include "state/calibrate_network.h"
#include "state/world.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

namespace weft {
namespace {

World build(const std::string& cloth, const std::filesystem::path& folder = ".") {
    return build_world(read_scene_text("[[cloth]]\nname = \"net\"\n" + cloth, "a.toml", folder),
                       [](const std::string&) {});
}

std::size_t count(const EdgeNetwork& network, EdgeKind kind) {
    return static_cast<std::size_t>(
        std::count_if(network.begin(), network.end(),
                      [&](const NetworkEdge& edge) { return edge.kind == kind; }));
}

const std::string k_grid = "grid = { size = [0.4, 0.3], cells = [4, 3] }\nmodel = \"cubic\"\n"
                           "scale = 2.0\n[cloth.spring]\nK = 500.0\nshear = 0.5\nbend = 7.0\n";

/// Two quads side by side and a triangle on top of the first, in a file.
std::filesystem::path write_quads(const test::TempFolder& folder) {
    std::ofstream(folder / "quads.obj")
        << "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 0.5 2 0\n"
           "f 1 2 5 4\nf 2 3 6 5\nf 4 5 7\n";
    return folder.path();
}

} // namespace

TEST(BuildNetwork, JoinsAGridBySidesBothDiagonalsAndEverySecondVertex) {
    const World world = build(k_grid);

    const EdgeNetwork& network = world.cloths[0].network;
    EXPECT_EQ(count(network, EdgeKind::Side), 4U * 4U + 5U * 3U);
    EXPECT_EQ(count(network, EdgeKind::Diagonal), 2U * 12U);
    EXPECT_EQ(count(network, EdgeKind::Bending), 3U * 4U + 5U * 2U);
    for (const NetworkEdge& edge : network) {
        const Vec3 across = world.positions[static_cast<std::size_t>(edge.vertices[1])] -
                            world.positions[static_cast<std::size_t>(edge.vertices[0])];
        EXPECT_NEAR(edge.rest_length, across.norm(), 1e-12); // a grid starts at rest
        EXPECT_EQ(edge.stiffness, edge.kind == EdgeKind::Side       ? 500.0
                                  : edge.kind == EdgeKind::Diagonal ? 250.0
                                                                    : 7.0);
    }
}

TEST(BuildNetwork, LeavesOutWhatHasNoStiffness) {
    const World world = build("grid = { size = [0.4, 0.3], cells = [4, 3] }\nmodel = \"linear\"\n"
                              "[cloth.spring]\nshear = 0.0\nbend = 0.0\n");

    EXPECT_EQ(world.cloths[0].network.size(), 31U);
}

TEST(BuildNetwork, CrossesTheQuadsOfAFileAndBendsAcrossItsOtherEdges) {
    const test::TempFolder folder;
    const World world = build("mesh = \"quads.obj\"\nmodel = \"linear\"\n", write_quads(folder));

    const EdgeNetwork& network = world.cloths[0].network;
    EXPECT_EQ(count(network, EdgeKind::Side), 9U);
    EXPECT_EQ(count(network, EdgeKind::Diagonal), 4U);
    EXPECT_EQ(count(network, EdgeKind::Bending), 2U);
    for (const NetworkEdge& edge : network) {
        if (edge.kind == EdgeKind::Diagonal) {
            EXPECT_NEAR(edge.rest_length, std::sqrt(2.0), 1e-12);
        }
    }
}

TEST(BuildNetwork, GivesTrianglesTheirBendingEdgesAlone) {
    const World world = build("grid = { size = [0.4, 0.3], cells = [4, 3] }\n"
                              "model = \"stvk_triangle\"\n");

    EXPECT_EQ(count(world.cloths[0].network, EdgeKind::Bending), world.cloths[0].network.size());
    EXPECT_EQ(world.cloths[0].network.size(), 22U);
}

TEST(BuildNetwork, GivesTheObjectTheMassOfItsSprings) {
    const World world = build(k_grid + "mass = 0.7\n");

    EXPECT_NEAR(std::accumulate(world.masses.begin(), world.masses.end(), 0.0), 0.7, 1e-12);
}

TEST(CalibrateNetwork, IsExactOnAGridWhereEdgesCanBe) {
    // edges alone have c12 = c33: E nu / (1 - nu^2) = G at nu = 1/3, E = 1000, G = 375
    const World world = build("grid = { size = [0.4, 0.4], cells = [8, 8] }\nmodel = \"cubic\"\n"
                              "[cloth.spring]\ncalibrate = true\n[cloth.fabric]\n"
                              "stretch = [1000.0, 1000.0]\npoisson = 0.3333333333333333\n"
                              "shear = 375.0\n");

    const NetworkModuli moduli = network_moduli(world.cloths[0]);

    EXPECT_NEAR(moduli.stretch[0], 1000.0, 1.0);
    EXPECT_NEAR(moduli.stretch[1], 1000.0, 1.0);
    EXPECT_NEAR(moduli.shear, 375.0, 0.5);
}

TEST(CalibrateNetwork, GivesAFabricTheSameStiffnessOnFinerMeshes) {
    const auto stretch = [](int cells) {
        const std::string n = std::to_string(cells);
        const World world = build("grid = { size = [0.4, 0.4], cells = [" + n + ", " + n +
                                  "] }\nmodel = \"cubic\"\n[cloth.spring]\ncalibrate = true\n");
        return network_moduli(world.cloths[0]).stretch[0];
    };
    EXPECT_NEAR(stretch(4), stretch(16), 1e-9 * stretch(4));
}

} // namespace weft
