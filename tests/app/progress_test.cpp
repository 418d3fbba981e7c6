#include "app/progress.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(DurationText, ChoosesItsUnits) {
    EXPECT_EQ(duration_text(-1.0), "0 s");
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(60.0), "1:00");
    EXPECT_EQ(duration_text(754.0), "12:34");
    EXPECT_EQ(duration_text(5025.0), "1:23:45");
}

TEST(FrameClock, CountsOnlyTheFramesOfThisProcess) {
    const FrameClock clock(40, 100); // resumed after frame 40

    EXPECT_EQ(clock.seconds_per_frame(40, 1.0), 0.0);
    EXPECT_EQ(clock.seconds_per_frame(50, 20.0), 2.0);
    EXPECT_EQ(clock.seconds_left(50, 20.0), 100.0);
    EXPECT_EQ(clock.seconds_left(100, 200.0), 0.0);
}

TEST(ProgressLine, NamesFrameTimeTrianglesAndContacts) {
    const std::string line = progress_line({.frame = 50, .triangles = 8192, .contacts = 77}, 200,
                                           FrameClock(0, 200), 25.0);

    EXPECT_EQ(line, "frame 50/200  25%  0.5 s/frame  1:15 left  8192 triangles  77 contacts");
}

} // namespace
} // namespace weft
