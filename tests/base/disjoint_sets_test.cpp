#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// Joins by renaming everything: slow and obvious.
void join_slowly(std::vector<Index>& names, Index a, Index b) {
    const Index from =
        std::max(names[static_cast<std::size_t>(a)], names[static_cast<std::size_t>(b)]);
    const Index to =
        std::min(names[static_cast<std::size_t>(a)], names[static_cast<std::size_t>(b)]);
    std::replace(names.begin(), names.end(), from, to);
}

} // namespace

TEST(DisjointSets, AreNamedAfterTheirLeastNumberWhateverTheOrderOfJoins) {
    constexpr Index k_count = 60;
    std::mt19937 random(7);
    std::uniform_int_distribution<Index> any(0, k_count - 1);
    DisjointSets sets(k_count);
    std::vector<Index> names(k_count);
    std::iota(names.begin(), names.end(), 0);
    for (int join = 0; join < 50; ++join) {
        const Index a = any(random);
        const Index b = any(random);
        sets.join(a, b);
        join_slowly(names, a, b);
        for (Index i = 0; i < k_count; ++i) {
            ASSERT_EQ(sets.find(i), names[static_cast<std::size_t>(i)]);
        }
    }
    sets.reset(k_count);
    EXPECT_EQ(sets.find(k_count - 1), k_count - 1);
}

} // namespace weft
