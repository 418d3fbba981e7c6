#include "render/png.h"
#include "render/renderer.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

namespace weft {
namespace {

Frame square_frame(double side, double value) {
    Frame frame;
    frame.objects.push_back(test::square_cloth(side, 8, [value](double, double) { return value; }));
    return frame;
}

/// Looks at the origin along -z from a distance, m.
RenderParams front_view(double distance) {
    RenderParams params;
    params.size = {320, 180};
    params.has_camera = true;
    params.camera = {.eye = {0.0, 0.0, distance}, .target = {0.0, 0.0, 0.0}, .fov_deg = 35.0};
    return params;
}

TEST(Renderer, CoveredShareOfASquareIsItsProjectedArea) {
    const Frame frame = square_frame(1.0, 1.0);
    Renderer renderer(front_view(3.0), subject_bounds(frame), {0.9, 1.2});

    PictureStats stats;
    renderer.draw(frame, &stats);

    const double visible_height = 2.0 * 3.0 * std::tan(17.5 * std::numbers::pi / 180.0); // m
    const double expected = 1.0 / (visible_height * visible_height * 320.0 / 180.0);
    const double side_pixels = 180.0 / visible_height;
    EXPECT_NEAR(stats.covered_share, expected, 4.0 * side_pixels / (320.0 * 180.0));
    EXPECT_GT(stats.covered_share, 0.5 * expected);
}

TEST(Renderer, SharesOutsideTheRangeAreThoseOfTheValues) {
    Frame frame;
    frame.objects.push_back(
        test::square_cloth(1.0, 64, [](double u, double) { return 0.8 + 0.5 * u; }));
    Renderer renderer(front_view(2.0), subject_bounds(frame), {0.9, 1.2});

    PictureStats stats;
    renderer.draw(frame, &stats);

    EXPECT_NEAR(stats.below_share, 0.2, 0.01);
    EXPECT_NEAR(stats.above_share, 0.2, 0.01);
}

TEST(Renderer, DrawsTheSameBytesAgainAlsoAfterAnotherFrameAndOnAnotherThread) {
    const Frame frame = square_frame(1.0, 1.05);
    const Frame other = square_frame(0.5, 1.4);
    Renderer renderer(front_view(3.0), subject_bounds(frame), {0.9, 1.2});

    const std::string first = encode_png(renderer.draw(frame));
    renderer.draw(other);
    std::string again;
    std::thread([&] { again = encode_png(renderer.draw(frame)); }).join();
    Renderer second(front_view(3.0), subject_bounds(frame), {0.9, 1.2});

    EXPECT_EQ(first, again);
    EXPECT_EQ(first, encode_png(second.draw(frame)));
}

} // namespace
} // namespace weft
