#include "base/parallel.h"
#include "render/renderer.h"
#include "support/golden.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace weft {
namespace {

/// The tablecloth, drawn by a new renderer that may use so many threads.
Image drawn_with(int threads) {
    set_thread_count(threads);
    setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1); // of OSMesa's rasteriser
    Frame frame;
    frame.objects = {test::draped_cloth(40), test::ball(0.3, 40)};
    RenderParams params;
    params.size = {640, 360};
    Image image = Renderer(params, subject_bounds(frame), {0.9, 1.2}).draw(frame);
    unsetenv("LP_NUM_THREADS");
    set_thread_count(0);
    return image;
}

TEST(Threads, DoNotChangeAByteOfThePicture) {
    const Image one = drawn_with(1);

    EXPECT_EQ(one.rgb, drawn_with(2).rgb);
    EXPECT_EQ(one.rgb, drawn_with(5).rgb);
}

} // namespace
} // namespace weft
