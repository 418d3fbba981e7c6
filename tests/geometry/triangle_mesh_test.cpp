#include "geometry/triangle_mesh.h"

#include <gtest/gtest.h>

namespace weft {

TEST(TriangleMesh, EdgeKnowsItsTrianglesAndApexes) {
    const std::vector<Triangle> quad{{0, 1, 2}, {0, 2, 3}};

    const EdgeTopology topology = build_edges(quad);

    ASSERT_EQ(topology.edges.size(), 5U);
    const MeshEdge& diagonal = topology.edges[at(topology.triangle_edges[0][1])];
    EXPECT_FALSE(diagonal.is_boundary());
    EXPECT_EQ(diagonal.v, (std::array<Index, 2>{2, 0}));
    EXPECT_EQ(diagonal.apex, (std::array<Index, 2>{1, 3}));
    EXPECT_EQ(topology.triangle_edges[1][2], topology.triangle_edges[0][1]);
}

TEST(TriangleMesh, BoundaryOfAQuadIsOneLoop) {
    const std::vector<Triangle> quad{{0, 1, 2}, {0, 2, 3}};

    const auto loops = boundary_loops(build_edges(quad));

    ASSERT_EQ(loops.size(), 1U);
    EXPECT_EQ(loops[0], (std::vector<Index>{0, 1, 2, 3}));
}

TEST(TriangleMesh, PartsThatShareNoVertexAreApart) {
    const std::vector<Triangle> triangles{{0, 1, 2}, {3, 4, 5}, {2, 1, 6}};
    std::vector<int> part;

    EXPECT_EQ(connected_parts(triangles, part), 2);
    EXPECT_EQ(part, (std::vector<int>{0, 1, 0}));
}

} // namespace weft
