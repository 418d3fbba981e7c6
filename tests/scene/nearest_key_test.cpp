#include "scene/key.h"

#include <gtest/gtest.h>

#include <vector>

namespace weft {
namespace {

const std::vector<std::string> k_keys{"frames", "fps", "gravity", "wind", "K1", "K2"};

TEST(NearestKey, CountsInsertionDeletionReplacementAndSwap) {
    EXPECT_EQ(nearest_key("frame", k_keys), "frames");
    EXPECT_EQ(nearest_key("winnd", k_keys), "wind");
    EXPECT_EQ(nearest_key("grevity", k_keys), "gravity");
    EXPECT_EQ(nearest_key("wnid", k_keys), "wind");
}

TEST(NearestKey, AWrongCaseIsNearerThanAWrongLetter) {
    EXPECT_EQ(nearest_key("k2", k_keys), "K2");
}

TEST(NearestKey, TheFirstOfEqualsWins) {
    EXPECT_EQ(nearest_key("K3", k_keys), "K1");
}

TEST(NearestKey, NoCandidatesGiveNoName) {
    EXPECT_EQ(nearest_key("frames", {}), "");
}

} // namespace
} // namespace weft
