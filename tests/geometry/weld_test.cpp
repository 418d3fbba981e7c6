#include "geometry/weld.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

TEST(Weld, VerticesAreNumberedByFirstAppearance) {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);

    const Weld weld = weld_vertices(std::vector<Vec3>{b, a, b, c, a}, 0.0);

    EXPECT_EQ(weld.positions, (std::vector<Vec3>{b, a, c}));
    EXPECT_EQ(weld.new_index, (std::vector<Index>{0, 1, 0, 2, 1}));
}

TEST(Weld, OnlyVerticesWithinTheToleranceAreJoined) {
    const std::vector<Vec3> positions{{0, 0, 0}, {0.009, 0, 0}, {0.011, 0, 0}, {1, 0, 0}};

    const Weld weld = weld_vertices(positions, 0.01);

    // The third lies within 0.01 of the second, but that one is not kept.
    EXPECT_EQ(weld.new_index, (std::vector<Index>{0, 0, 1, 2}));
}

TEST(Weld, AgreesWithComparingAllPairs) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::vector<Vec3> positions;
    for (int i = 0; i < 1000; ++i) {
        positions.emplace_back(0.2 * place(random), 0.2 * place(random), place(random));
    }
    constexpr double tolerance = 0.03;

    const Weld weld = weld_vertices(positions, tolerance);

    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        Index nearest = k_no_index;
        double least = tolerance;
        for (std::size_t k = 0; k < kept.size(); ++k) {
            if ((kept[k] - positions[i]).norm() < least) {
                least = (kept[k] - positions[i]).norm();
                nearest = static_cast<Index>(k);
            }
        }
        if (nearest == k_no_index) {
            nearest = static_cast<Index>(kept.size());
            kept.push_back(positions[i]);
        }
        ASSERT_EQ(weld.new_index[i], nearest) << "vertex " << i;
    }
    EXPECT_EQ(weld.positions, kept);
    EXPECT_LT(kept.size(), positions.size());
}

} // namespace weft
