#include "render/renderer.h"
#include "support/golden.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

// Pictures are the same to the byte on one machine; another one's OpenGL may round otherwise.
constexpr double k_limit = 1.0; // mean levels of 255

RenderParams small() {
    RenderParams params;
    params.size = {320, 180};
    return params;
}

Frame draped_frame() {
    Frame frame;
    frame.number = 12;
    frame.time = 0.44;
    frame.objects = {test::draped_cloth(48), test::ball(0.3, 48)};
    return frame;
}

TEST(Golden, TableclothOverABall) {
    const Frame frame = draped_frame();

    const Image image = Renderer(small(), subject_bounds(frame), {0.9, 1.2}).draw(frame);

    EXPECT_LT(test::compare_with_golden(image, "tablecloth", k_limit), k_limit);
}

TEST(Golden, SeedMapOnABlockOnAWideFloor) {
    Frame frame = draped_frame();
    frame.objects[1] = test::box({0.0, -0.35, 0.0}, {0.25, 0.33, 0.25});
    frame.objects.push_back(test::box({0.0, -0.70, 0.0}, {10.0, 0.02, 10.0}));
    RenderParams params = small();
    params.map = "seed";
    params.edges = false;

    const Image image = Renderer(params, subject_bounds(frame), {0.95, 1.05}).draw(frame);

    EXPECT_LT(test::compare_with_golden(image, "block", k_limit), k_limit);
}

TEST(Golden, ADifferenceIsNoticed) {
    Frame frame = draped_frame();
    for (float& value : frame.objects[0].values[0]) {
        value += 0.03F;
    }

    const Image image = Renderer(small(), subject_bounds(frame), {0.9, 1.2}).draw(frame);

    EXPECT_GT(test::mean_difference(image, test::read_golden("tablecloth")), k_limit);
}

} // namespace
} // namespace weft
