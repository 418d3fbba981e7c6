#include "render/camera.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Extent of the projected corners as shares of the picture: left, right, top, bottom.
std::array<double, 4>
projected_extent(const Box3& box, const CameraParams& params, const std::array<int, 2>& size) {
    const Camera camera = place_camera(params, size, box);
    std::array<double, 4> extent{1e9, -1e9, 1e9, -1e9};
    for (int i = 0; i < 8; ++i) {
        const Vec3 p = project(camera, size, box.corner(static_cast<Box3::CornerType>(i)));
        EXPECT_GT(p.z(), 0.0);
        extent[0] = std::min(extent[0], p.x() / size[0]);
        extent[1] = std::max(extent[1], p.x() / size[0]);
        extent[2] = std::min(extent[2], p.y() / size[1]);
        extent[3] = std::max(extent[3], p.y() / size[1]);
    }
    return extent;
}

TEST(FrameCamera, KeepsAnyBoxInThePictureAndFillsOneWay) {
    const std::vector<Box3> boxes{Box3(Vec3(-0.8, -0.82, -0.2), Vec3(0.8, 0.85, 0.2)),
                                  Box3(Vec3(-2.0, 0.0, -2.0), Vec3(2.0, 0.01, 2.0)),
                                  Box3(Vec3(100.0, 5.0, -7.0), Vec3(100.1, 9.0, -6.9)),
                                  Box3(Vec3(-0.001, 0.0, 0.0), Vec3(0.001, 0.002, 0.003))};
    for (const Box3& box : boxes) {
        for (const std::array<int, 2>& size :
             {std::array{1280, 720}, std::array{400, 800}, std::array{512, 512}}) {
            const auto [left, right, top, bottom] =
                projected_extent(box, frame_camera(box, size), size);

            EXPECT_GT(left, 0.05);
            EXPECT_LT(right, 0.86); // the legend stands to the right
            EXPECT_GT(top, 0.05);
            EXPECT_LT(bottom, 0.95);
            EXPECT_GT(std::max(right - left, bottom - top), 0.78);
        }
    }
}

TEST(FrameCamera, LooksFromTheFrontRightAndAbove) {
    const CameraParams camera = frame_camera(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)), {1280, 720});
    const Vec3 view = camera.eye - camera.target;

    EXPECT_GT(view.z(), view.x());
    EXPECT_GT(view.x(), 0.0);
    EXPECT_GT(view.y(), 0.0);
    EXPECT_DOUBLE_EQ(camera.fov_deg, 35.0);
}

TEST(FrameCamera, ANothingOrAPointIsLookedAtFromAFiniteDistance) {
    for (const Box3& box : {Box3(), Box3(Vec3(1, 2, 3), Vec3(1, 2, 3))}) {
        const CameraParams camera = frame_camera(box, {1280, 720});

        EXPECT_TRUE(camera.eye.allFinite() && camera.target.allFinite());
        EXPECT_GT((camera.eye - camera.target).norm(), 0.5);
    }
}

TEST(Camera, ProjectsTheTargetToTheMiddleAndUpToUp) {
    const std::array<int, 2> size{640, 360};
    const CameraParams params{.eye = {0, 0, 2}, .target = {0, 0, 0}, .fov_deg = 90.0};
    const Camera camera = place_camera(params, size, Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));

    const Vec3 middle = project(camera, size, {0, 0, 0});
    const Vec3 top = project(camera, size, {0, 2, 0}); // tan 45 degrees times 2 m

    EXPECT_NEAR(middle.x(), 320.0, 1e-3);
    EXPECT_NEAR(middle.y(), 180.0, 1e-3);
    EXPECT_NEAR(top.x(), 320.0, 1e-3);
    EXPECT_NEAR(top.y(), 0.0, 1e-3);
}

TEST(Camera, LookingStraightDownHasFiniteAxes) {
    const CameraParams params{.eye = {0, 3, 0}, .target = {0, 0, 0}};

    const Camera camera = place_camera(params, {640, 360}, Box3());

    EXPECT_TRUE(camera.view_projection.allFinite());
    EXPECT_NEAR(camera.right.dot(camera.up), 0.0, 1e-12);
}

TEST(SubjectBounds, LeaveAFloorOutThatDwarfsTheCloth) {
    Frame frame;
    frame.objects = {test::draped_cloth(8), test::ball(0.3, 8),
                     test::box({0.0, -1.0, 0.0}, {10.0, 0.01, 10.0})};

    const Box3 bounds = subject_bounds(frame);

    EXPECT_LT(bounds.diagonal().norm(), 2.5);
    EXPECT_GT(bounds.min().y(), -0.9);
}

TEST(SubjectBounds, WithoutClothAreThoseOfTheObstacles) {
    Frame frame;
    frame.objects = {test::ball(0.3, 8), test::box({2.0, 0.0, 0.0}, {0.2, 0.2, 0.2})};

    EXPECT_NEAR(subject_bounds(frame).sizes().x(), 2.5, 1e-6);
    EXPECT_TRUE(subject_bounds(Frame{}).isEmpty());
}

} // namespace
} // namespace weft
