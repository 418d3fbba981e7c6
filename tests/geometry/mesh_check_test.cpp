#include "geometry/mesh_check.h"

#include <gtest/gtest.h>

#include <limits>

namespace weft {

namespace {

const std::vector<Vec3> k_square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

using Edges = std::vector<std::array<Index, 2>>;

} // namespace

TEST(MeshCheck, ASoundMeshHasNoDefects) {
    const MeshDefects defects = find_defects(k_square, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});

    EXPECT_TRUE(defects.is_sound());
    EXPECT_TRUE(defects.unused_vertices.empty());
    EXPECT_TRUE(defects.pinched_vertices.empty());
}

TEST(MeshCheck, NamesVerticesThatAreNotFiniteOrUnused) {
    std::vector<Vec3> positions = k_square;
    positions[1].y() = std::numeric_limits<double>::quiet_NaN();
    positions.emplace_back(2, 2, std::numeric_limits<double>::infinity());

    const MeshDefects defects = find_defects(positions, std::vector<Triangle>{{0, 1, 2}});

    EXPECT_EQ(defects.not_finite, (std::vector<Index>{1, 4}));
    EXPECT_EQ(defects.unused_vertices, (std::vector<Index>{3, 4}));
}

TEST(MeshCheck, NamesTrianglesWithoutAreaAltitudeOrVertex) {
    std::vector<Vec3> positions = k_square;
    positions.emplace_back(0.5, 1e-7, 0); // altitude 1e-7 over the edge 0-1, size 1.4

    const MeshDefects defects = find_defects(
        positions, std::vector<Triangle>{{0, 1, 2}, {0, 1, 4}, {2, 2, 3}, {0, 2, 9}, {-1, 2, 3}});

    EXPECT_EQ(defects.degenerate, (std::vector<Index>{1, 2}));
    EXPECT_EQ(defects.out_of_range, (std::vector<Index>{3, 4}));
}

TEST(MeshCheck, NamesTheSecondOfTwoEqualTriangles) {
    const MeshDefects defects =
        find_defects(k_square, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {2, 1, 0}});

    EXPECT_EQ(defects.duplicates, std::vector<Index>{2});
}

TEST(MeshCheck, NamesEdgesWithThreeTrianglesAndBrokenWinding) {
    std::vector<Vec3> positions = k_square;
    positions.emplace_back(0.5, 0.5, 1);

    const MeshDefects fin =
        find_defects(positions, std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 2, 4}});
    const MeshDefects flipped = find_defects(k_square, std::vector<Triangle>{{0, 1, 2}, {0, 3, 2}});

    EXPECT_EQ(fin.non_manifold_edges, (Edges{{0, 2}}));
    EXPECT_TRUE(fin.winding_edges.empty());
    EXPECT_EQ(flipped.winding_edges, (Edges{{0, 2}}));
}

TEST(MeshCheck, NamesTheVertexWhereTwoFansTouch) {
    const std::vector<Vec3> bow{{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};

    const MeshDefects defects = find_defects(bow, std::vector<Triangle>{{0, 2, 1}, {0, 3, 4}});

    EXPECT_EQ(defects.pinched_vertices, std::vector<Index>{0});
    EXPECT_TRUE(defects.is_sound());
}

TEST(MeshCheck, NamesOnlyTheFirstFewElements) {
    EXPECT_EQ(first_few(std::vector<Index>{4, 7}), "4, 7");
    EXPECT_EQ(first_few(std::vector<Index>{1, 2, 3, 4, 5, 6, 7}), "1, 2, 3, 4, 5 and 2 more");
    EXPECT_EQ(first_few(Edges{{0, 2}}), "0-2");
}

} // namespace weft
