#include "frames/predicted_bounds.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// An upright square cloth of a metre in z = 0 around the origin, and a scene of `seconds` for it.
struct Shown {
    Frame frame;
    Scene scene;

    explicit Shown(double seconds) {
        frame.objects = {test::square_cloth(1.0, 10, [](double, double) { return 1.0; })};
        scene.cloths.resize(1);
        scene.scene.fps = 20.0;
        scene.scene.frames = 1 + static_cast<int>(std::lround(20.0 * seconds));
        scene.scene.air_density = 0.0;
    }
    void add(const FrameObject& object, const ObstacleParams& params = {}) {
        frame.objects.push_back(object);
        frame.objects.back().kind = ObjectKind::Obstacle;
        scene.obstacles.push_back(params);
    }
    Box3 predict() const {
        return predict_bounds(frame, scene, std::vector<bool>(frame.objects.size(), true)).box();
    }
};

TEST(PredictedBounds, FreeClothFallsForTheRestOfTheRun) {
    const Box3 box = Shown(1.0).predict();

    EXPECT_NEAR(box.min().y(), -0.5 - 0.5 * 9.81, 1e-6); // g t^2 / 2
    EXPECT_NEAR(box.max().y(), 0.5, 1e-6);
    EXPECT_NEAR(box.sizes().x(), 1.0, 1e-6);
}

TEST(PredictedBounds, AirHoldsFallingClothBack) {
    Shown shown(10.0);
    shown.scene.scene.air_density = 1.2;

    // sqrt(2 * 0.15 * 9.81 / (1.2 * 1.2)) = 1.43 m/s
    EXPECT_NEAR(shown.predict().min().y(), -0.5 - 14.3, 0.5);
}

TEST(PredictedBounds, ClothLandsOnWhatLiesBelow) {
    Shown shown(5.0);
    shown.add(test::box({0.0, -1.1, 0.0}, {3.0, 0.1, 3.0}));

    const Box3 box = predict_bounds(shown.frame, shown.scene, {true, false}).box();

    EXPECT_NEAR(box.min().y(), -1.0, 1e-6);
}

TEST(PredictedBounds, ClothOverAnEdgeHangsByItsLengthFromThere) {
    Shown shown(5.0);
    for (Vec3f& x : shown.frame.objects[0].positions) {
        x = Vec3f(x.x(), 0.0F, -x.y()); // level
    }
    shown.add(test::box({-1.3, -1.1, 0.0}, {1.4, 0.1, 3.0})); // under x < 0.1, its top at y = -1

    const Box3 box = predict_bounds(shown.frame, shown.scene, {true, false}).box();

    EXPECT_NEAR(box.min().y(), -1.0 - 0.4, 0.01);
}

TEST(PredictedBounds, WhatIsPinnedHangsFromItsPinsAndGoesWithThem) {
    Shown shown(5.0);
    for (Vec3f& x : shown.frame.objects[0].positions) {
        x = Vec3f(x.x(), 0.0F, -x.y()); // level, from z = -0.5 to 0.5
    }
    PinParams pin;
    pin.has_box = true;
    pin.box_min = {-1.0, -1.0, -0.51};
    pin.box_max = {1.0, 1.0, -0.49};
    pin.move = {{0.0, 0.0, 0.0, 0.0}, {1.0, 2.0, 0.0, 0.0}};
    shown.scene.cloths[0].pins = {pin};

    const Box3 box = shown.predict();

    EXPECT_NEAR(box.min().y(), -1.0, 0.03);
    EXPECT_NEAR(box.max().y(), 0.0, 0.03);
    EXPECT_NEAR(box.min().z(), -1.5, 0.03); // without air it swings up as far on the other side
    EXPECT_NEAR(box.max().z(), 0.5, 0.03);
    EXPECT_NEAR(box.max().x(), 2.5, 0.03);
}

TEST(PredictedBounds, ObstaclesReachAsFarAsTheirKeyFrames) {
    Shown shown(2.0);
    shown.scene.scene.gravity = Vec3::Zero();
    ObstacleParams params;
    params.motion = {{.t = 0.0}, {.t = 2.0, .rotate_deg = {0.0, 90.0, 0.0}}};
    shown.add(test::box({0.0, 0.0, 0.0}, {3.0, 0.1, 0.1}), params);

    const Box3 box = shown.predict();

    EXPECT_NEAR(box.max().x(), 3.0, 0.01); // hypot(3, 0.1) at 2 degrees
    EXPECT_NEAR(box.max().z(), 3.0, 0.01);
}

TEST(PredictedBounds, ObstaclesThatDeformReachAsFarAsTheySay) {
    Shown shown(2.0);
    shown.scene.scene.gravity = Vec3::Zero();
    shown.add(test::box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), {});
    shown.frame.objects.back().reach = {{0.0F, 0.0F, 0.0F}, {4.0F, 1.0F, 1.0F}};

    const Box3 box = shown.predict();

    EXPECT_NEAR(box.max().x(), 4.0, 1e-6);
}

TEST(PredictedBounds, OfNothingAreEmpty) {
    EXPECT_TRUE(predict_bounds({}, {}, {}).is_empty());
}

} // namespace
} // namespace weft
