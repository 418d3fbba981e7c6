#include "base/error.h"
#include "render/image.h"
#include "render/renderer.h"
#include "support/golden.h"
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

TEST(Renderer, LightScalesTheColourOfAValueAndKeepsItsHue) {
    for (const char* map : {"seed", "coolwarm", "viridis", "turbo", "cividis"}) {
        for (const double value : {0.93, 1.0, 1.1, 1.19}) {
            const Frame frame = square_frame(1.0, value);
            RenderParams params = front_view(3.0);
            params.map = map;
            params.edges = false;
            Renderer renderer(params, subject_bounds(frame), {0.9, 1.2});

            const Image image = renderer.draw(frame);

            const std::uint8_t* pixel = image.pixel(160, 90);
            const Colour shown =
                linear_from_srgb(Colour{pixel[0] / 255.0F, pixel[1] / 255.0F, pixel[2] / 255.0F});
            const Colour expected = linear_from_srgb(renderer.scale().colour(value));
            const auto sum = [](const Colour& c) { return c[0] + c[1] + c[2]; };
            const float light = sum(shown) / sum(expected);
            EXPECT_GT(light, 0.6F) << map;
            EXPECT_LT(light, 1.1F) << map;
            for (std::size_t i = 0; i < 3; ++i) { // a level of 255 is 0.01 of linear light
                EXPECT_NEAR(shown[i], light * expected[i], 0.012F) << map << " " << value;
            }
        }
    }
}

TEST(Renderer, ValuesOutsideTheRangeShowTheirOwnColours) {
    const Frame frame = square_frame(1.0, 1.3);
    RenderParams params = front_view(3.0);
    params.edges = false;
    Renderer renderer(params, subject_bounds(frame), {0.9, 1.2});

    PictureStats stats;
    const Image image = renderer.draw(frame, &stats);

    const std::uint8_t* pixel = image.pixel(160, 90);
    EXPECT_GT(pixel[0], 1.5 * pixel[1]);
    EXPECT_GT(pixel[2], 1.5 * pixel[1]);
    EXPECT_DOUBLE_EQ(stats.above_share, 1.0);
    EXPECT_DOUBLE_EQ(stats.below_share, 0.0);
}

TEST(Renderer, MeanColourIsThatOfTheBytes) {
    const Frame frame = square_frame(1.0, 1.0);
    Renderer renderer(front_view(3.0), subject_bounds(frame), {0.9, 1.2});

    PictureStats stats;
    const Image image = renderer.draw(frame, &stats);

    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        sum[i % 3] += image.rgb[i] / 255.0;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(stats.mean_colour[i], sum[i] / (320.0 * 180.0), 1e-9);
    }
}

TEST(Renderer, EdgesDarkenLinesOfTheMeshOnly) {
    const Frame frame = square_frame(1.0, 1.0); // 8 cells a side, some 12 pixels each
    RenderParams params = front_view(3.0);
    const Image with = Renderer(params, subject_bounds(frame), {0.9, 1.2}).draw(frame);
    params.edges = false;
    const Image without = Renderer(params, subject_bounds(frame), {0.9, 1.2}).draw(frame);

    int darker = 0;
    int brighter = 0;
    for (std::size_t i = 0; i < with.rgb.size(); ++i) {
        darker += with.rgb[i] + 8 < without.rgb[i] ? 1 : 0;
        brighter += with.rgb[i] > without.rgb[i] + 1 ? 1 : 0;
    }
    EXPECT_GT(darker, 1000);
    EXPECT_EQ(brighter, 0);
}

TEST(Renderer, ClothSeenFromBehindIsLitToo) {
    const Frame frame = square_frame(1.0, 1.0);
    RenderParams params = front_view(-3.0);
    params.edges = false;

    const Image image = Renderer(params, subject_bounds(frame), {0.9, 1.2}).draw(frame);

    EXPECT_GT(image.pixel(160, 90)[1], 150);
}

/// Draws a frame that might upset something; the picture must be whole and its statistics sane.
void expect_drawn(const Frame& frame, const RenderParams& params) {
    Renderer renderer(params, subject_bounds(frame), {0.9, 1.2});
    PictureStats stats;
    const Image image = renderer.draw(frame, &stats);
    ASSERT_EQ(image.rgb.size(), 3U * 320U * 180U);
    for (const double share : {stats.covered_share, stats.above_share, stats.below_share}) {
        EXPECT_GE(share, 0.0);
        EXPECT_LE(share, 1.0);
    }
    EXPECT_GT(stats.mean_colour[1], 0.01); // inside a closed ball it is dark
}

TEST(Renderer, DrawsWhateverAFrameHolds) {
    RenderParams automatic;
    automatic.size = {320, 180};
    const Frame square = square_frame(1.0, 1.0);
    Frame obstacle_only;
    obstacle_only.objects = {test::ball(0.3, 12)};
    Frame empty_objects;
    empty_objects.objects.resize(2);
    empty_objects.objects[1].kind = ObjectKind::Obstacle;
    Frame on_a_floor = square;
    on_a_floor.objects.push_back(test::box({0.0, -0.52, 0.0}, {10.0, 0.01, 10.0}));
    Frame point = square_frame(0.0, 1.0);

    for (const Frame& frame : {Frame{}, square, obstacle_only, empty_objects, on_a_floor, point}) {
        expect_drawn(frame, automatic);
        expect_drawn(frame, front_view(3.0));
        expect_drawn(frame, front_view(-0.1)); // most of it behind the camera or cut by it
    }
}

TEST(Renderer, AnUnknownMapQuantityOrEmptyRangeIsNamed) {
    const auto message = [](const RenderParams& params) -> std::string {
        try {
            const Renderer renderer(params, Box3(), {0.9, 1.2});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::BadInput);
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message({.map = "jet"}), "render.map = \"jet\": must be one of seed, coolwarm, "
                                       "viridis, turbo, cividis");
    EXPECT_NE(message({.quantity = "heat"}).find("render.quantity = \"heat\""), std::string::npos);
    EXPECT_NE(message({.has_range = true, .range = {1.0, 1.0}}).find("render.range"),
              std::string::npos);
}

TEST(Renderer, SupersamplingChangesDetailNotTheWhole) {
    const Frame frame = square_frame(1.0, 1.0);
    std::array<Image, 4> images;
    for (int i = 0; i < 4; ++i) {
        RenderParams params = front_view(3.0);
        params.supersample = i + 1;
        images[static_cast<std::size_t>(i)] =
            Renderer(params, subject_bounds(frame), {0.9, 1.2}).draw(frame);
    }
    for (const Image& image : images) {
        EXPECT_LT(test::mean_difference(image, images[3]), 1.0);
    }
}

} // namespace
} // namespace weft
