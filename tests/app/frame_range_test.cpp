#include "app/frame_range.h"
#include "base/error.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(FrameRange, NamesItsFrames) {
    const FrameRange range = parse_frame_range("3-9x2");

    EXPECT_FALSE(range.contains(1));
    EXPECT_TRUE(range.contains(3));
    EXPECT_FALSE(range.contains(4));
    EXPECT_TRUE(range.contains(9));
    EXPECT_FALSE(range.contains(11));
}

TEST(FrameRange, OneNumberIsThatFrameAlone) {
    const FrameRange range = parse_frame_range("7");

    EXPECT_EQ(range.first, 7);
    EXPECT_EQ(range.last, 7);
}

TEST(FrameRange, HoldsAllFramesWhenNothingIsSaid) {
    EXPECT_TRUE(FrameRange{}.contains(1));
    EXPECT_TRUE(FrameRange{}.contains(100000));
}

TEST(FrameRange, RefusesWhatIsNoRange) {
    for (const char* text :
         {"", "0-3", "5-3", "1-", "-3", "1-3x", "1-3x0", "1-3x2y", "a-b", "99999999999"}) {
        EXPECT_THROW(parse_frame_range(text), Error) << text;
    }
}

TEST(FrameRange, MustEndWithinTheScene) {
    EXPECT_NO_THROW(check_frame_range(parse_frame_range("1-10"), 10));
    EXPECT_NO_THROW(check_frame_range(FrameRange{}, 10));
    EXPECT_THROW(check_frame_range(parse_frame_range("1-11"), 10), Error);
}

} // namespace
} // namespace weft
