#include "geometry/mesh_measure.h"

#include <gtest/gtest.h>

#include <limits>

namespace weft {
namespace {

constexpr double k_far = std::numeric_limits<double>::infinity();

/// A strip of unit squares along x, vertices 2i at y = 0 and 2i + 1 at y = 1.
struct Strip {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;

    explicit Strip(Index squares) {
        for (Index i = 0; i <= squares; ++i) {
            positions.emplace_back(i, 0, 0);
            positions.emplace_back(i, 1, 0);
        }
        for (Index i = 0; i < squares; ++i) {
            triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
            triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
        }
    }
};

TEST(MeshDistances, RunAlongEdgesFromTheNearestStart) {
    const Strip strip(10);
    std::vector<double> start(strip.positions.size(), k_far);
    start[0] = 0.0;
    start[20] = 0.0;

    const MeshDistances result = mesh_distances(strip.positions, strip.triangles, start);

    EXPECT_NEAR(result.cost[8], 4.0, 1e-12);
    EXPECT_EQ(result.source[8], 0);
    EXPECT_NEAR(result.cost[16], 2.0, 1e-12);
    EXPECT_EQ(result.source[16], 20);
    EXPECT_NEAR(result.cost[3], std::sqrt(2.0), 1e-12); // the diagonal of the first square
}

TEST(MeshDistances, ADearStartIsPassedOver) {
    const Strip strip(10);
    std::vector<double> start(strip.positions.size(), k_far);
    start[0] = 1.0;
    start[20] = 30.0;

    const MeshDistances result = mesh_distances(strip.positions, strip.triangles, start);

    EXPECT_NEAR(result.cost[20], 11.0, 1e-12);
    EXPECT_EQ(result.source[20], 0);
}

TEST(MeshDistances, NoWayLeadsToAnotherPart) {
    Strip strip(2);
    strip.positions.emplace_back(0, 0, 5);
    std::vector<double> start(strip.positions.size(), k_far);
    start[0] = 0.0;

    const MeshDistances result = mesh_distances(strip.positions, strip.triangles, start);

    EXPECT_EQ(result.cost.back(), k_far);
    EXPECT_EQ(result.source.back(), k_no_index);
}

} // namespace
} // namespace weft
