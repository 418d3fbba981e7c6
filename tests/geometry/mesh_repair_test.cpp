#include "geometry/mesh_check.h"
#include "geometry/mesh_repair.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Strip of n quads whose rungs are (2i, 2i + 1); `twisted` joins the last rung to the first upside
/// down.
std::vector<Triangle> closed_strip(Index n, bool twisted) {
    std::vector<Triangle> triangles;
    for (Index i = 0; i < n; ++i) {
        const bool turn = twisted && i == n - 1;
        const Index a = 2 * i;
        const Index c = (2 * i + 2) % (2 * n);
        const Index next_low = turn ? c + 1 : c;
        const Index next_high = turn ? c : c + 1;
        triangles.push_back({a, next_low, next_high});
        triangles.push_back({a, next_high, a + 1});
    }
    return triangles;
}

} // namespace

TEST(MeshRepair, TheFewerTrianglesOfAPartAreTurned) {
    std::vector<Triangle> ring = closed_strip(8, false);
    const std::vector<Triangle> sound = ring;
    for (const std::size_t t : {2U, 3U, 9U}) {
        std::swap(ring[t][1], ring[t][2]);
    }

    const OrientReport report = orient_consistently(ring);

    EXPECT_TRUE(report.is_orientable);
    EXPECT_EQ(report.flipped, (std::vector<Index>{2, 3, 9}));
    EXPECT_EQ(ring, sound);
}

TEST(MeshRepair, AMoebiusStripIsLeftAsItIs) {
    std::vector<Triangle> strip = closed_strip(8, true);
    const std::vector<Triangle> before = strip;

    const OrientReport report = orient_consistently(strip);

    EXPECT_FALSE(report.is_orientable);
    EXPECT_EQ(strip, before);
}

TEST(MeshRepair, VolumeOfATetrahedronIsASixthAndSigned) {
    const std::vector<Vec3> corners{{5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}};
    const std::vector<Triangle> outward{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const std::vector<Triangle> inward{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};

    EXPECT_NEAR(enclosed_volume(corners, outward), 1.0 / 6.0, 1e-14);
    EXPECT_NEAR(enclosed_volume(corners, inward), -1.0 / 6.0, 1e-14);
}

} // namespace weft
