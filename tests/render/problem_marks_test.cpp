#include "render/drawn_scene.h"
#include "render/renderer.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// Looks at the origin along -z from 3 m; a ball of 0.3 m stands there.
RenderParams front_view() {
    RenderParams params;
    params.size = {320, 180};
    params.legend = false;
    params.has_camera = true;
    params.camera = {.eye = {0.0, 0.0, 3.0}, .target = {0.0, 0.0, 0.0}, .fov_deg = 35.0};
    return params;
}

Image draw(const std::vector<Vec3f>& problems, bool wanted) {
    Frame frame;
    frame.objects.push_back(test::ball(0.3, 12));
    frame.problems = problems;
    RenderParams params = front_view();
    params.problems = wanted;
    const Box3 motion(-0.3 * Vec3::Ones(), 0.3 * Vec3::Ones());
    return Renderer(params, motion, {0.9, 1.2}).draw(frame);
}

/// Pixels that two pictures differ in.
std::vector<std::array<int, 2>> changed(const Image& a, const Image& b) {
    std::vector<std::array<int, 2>> pixels;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            if (!std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y))) {
                pixels.push_back({x, y});
            }
        }
    }
    return pixels;
}

TEST(ProblemMarks, RingTheirPlaceAlsoBehindAnObstacle) {
    const Image plain = draw({}, true);
    const std::vector<Vec3f> behind{Vec3f(0.1F, -0.05F, -0.5F)};

    const auto pixels = changed(plain, draw(behind, true));

    ASSERT_GT(pixels.size(), 20U);
    const Camera camera =
        place_camera(front_view().camera, {320, 180}, Box3(-Vec3::Ones(), Vec3::Ones()));
    const Vec3 centre = project(camera, {320, 180}, behind[0].cast<double>());
    for (const auto& [x, y] : pixels) {
        EXPECT_LT(std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y()), 12.0);
        EXPECT_GT(std::hypot(x + 0.5 - centre.x(), y + 0.5 - centre.y()), 2.0); // it stays visible
    }
}

TEST(ProblemMarks, AreDrawnOnlyWhenAskedFor) {
    EXPECT_TRUE(changed(draw({}, true), draw({Vec3f::Zero()}, false)).empty());
}

TEST(ProblemMarks, BehindTheCameraOrFarAsideLeaveThePictureAlone) {
    const std::vector<Vec3f> unseen{Vec3f(0.0F, 0.0F, 4.0F), Vec3f(1e6F, 0.0F, 0.0F),
                                    Vec3f(0.0F, 1e6F, 2.9999F)};

    EXPECT_TRUE(changed(draw({}, true), draw(unseen, true)).empty());
}

} // namespace
} // namespace weft
