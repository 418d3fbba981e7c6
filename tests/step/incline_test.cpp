#include "step/advance.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace weft {

namespace {

constexpr double k_friction = 0.3;
constexpr double k_gravity = 9.81;

/// A small sheet at its contact thickness on a wide plane; gravity is turned instead of the plane.
Scene sheet_on_incline(double degrees, int substeps) {
    ClothParams sheet = test::record_sheet(4);
    sheet.grid_size = {0.2, 0.2};
    sheet.fabric.friction = k_friction;
    sheet.placement.translate = Vec3(0.03, sheet.fabric.thickness, 0.02);
    Scene scene = test::scene_of(sheet);
    scene.scene.fps = 20.0;
    scene.scene.substeps = substeps;
    scene.scene.air_density = 0.0;
    const double angle = degrees * std::numbers::pi / 180.0;
    scene.scene.gravity = k_gravity * Vec3(std::sin(angle), -std::cos(angle), 0.0);
    scene.obstacles.push_back({.name = "plane",
                               .shape = Shape::Plane,
                               .size = Vec3(20.0, 0.0, 20.0),
                               .friction = k_friction});
    return scene;
}

/// Mean displacement and velocity down the incline after 1 s.
struct Slide {
    double distance, speed;
};

Slide slide_for_a_second(const Scene& scene) {
    World world = test::build_quietly(scene);
    const std::vector<Vec3> start = world.positions;
    Stepper stepper({world, scene.scene, scene.contact});
    for (int frame = 0; frame < 20; ++frame) {
        stepper.advance_frame(world, {});
    }
    Slide slide{0.0, 0.0};
    for (std::size_t i = 0; i < start.size(); ++i) {
        slide.distance += (world.positions[i] - start[i]).x() / static_cast<double>(start.size());
        slide.speed += world.velocities[i].x() / static_cast<double>(start.size());
    }
    return slide;
}

const double k_threshold_deg = std::atan(k_friction) * 180.0 / std::numbers::pi;

} // namespace

TEST(Incline, SheetSticksBelowTheFrictionAngle) {
    for (const int substeps : {3, 5, 10}) {
        const Slide slide = slide_for_a_second(sheet_on_incline(k_threshold_deg - 1.0, substeps));

        EXPECT_LT(std::abs(slide.distance), 1e-4) << substeps;
    }
}

TEST(Incline, SheetSlidesAboveTheFrictionAngle) {
    const double angle = (k_threshold_deg + 1.0) * std::numbers::pi / 180.0;
    const double expected =
        0.5 * k_gravity * (std::sin(angle) - k_friction * std::cos(angle)); // after 1 s: 0.09 m
    for (const int substeps : {3, 5, 10}) {
        const Slide slide = slide_for_a_second(sheet_on_incline(k_threshold_deg + 1.0, substeps));

        EXPECT_NEAR(slide.distance, expected, 0.05 * expected) << substeps;
    }
}

TEST(Incline, SlidingAcceleratesAsCoulombSays) {
    const double expected = k_gravity * (0.5 - k_friction * std::sqrt(3.0) / 2.0); // 30 degrees
    for (const int substeps : {3, 5, 10}) {
        const Slide slide = slide_for_a_second(sheet_on_incline(30.0, substeps));

        EXPECT_NEAR(slide.speed, expected, 0.02 * expected) << substeps; // after 1 s
    }
}

} // namespace weft
