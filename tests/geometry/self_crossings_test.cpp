#include "geometry/self_crossings.h"

#include <gtest/gtest.h>

namespace weft {

TEST(SelfCrossings, AFoldThatPassesThroughItselfIsFound) {
    TriangleMesh mesh; // one triangle flat on the ground, one upright through its middle, one apart
    mesh.positions = {{0, 0, 0},     {2, 0, 0}, {0, 0, 2}, {0.5, -1, 0.5}, {0.5, 1, 0.5},
                      {0.7, 1, 0.5}, {5, 0, 0}, {6, 0, 0}, {5, 0, 1}};
    mesh.triangles = {{6, 7, 8}, {0, 1, 2}, {3, 4, 5}};

    EXPECT_EQ(find_self_crossings(mesh), (std::vector<std::array<Index, 2>>{{1, 2}}));
}

TEST(SelfCrossings, NeighboursThatOnlyTouchDoNotCount) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {-1, 0, -1}, {-1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}};

    EXPECT_TRUE(find_self_crossings(mesh).empty());
}

} // namespace weft
