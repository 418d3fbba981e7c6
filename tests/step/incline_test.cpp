#include "step/advance.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace weft {

namespace {

constexpr double k_friction = 0.3;
constexpr double k_gravity = 9.81;

/// m/s. Friction that sticks is a spring, and the cloth stretches under its weight: 1.6e-5 m/s of
/// that settling are left after 1 s. weft validate allows the same creep of 0.1 mm in 1 s.
constexpr double k_creep = 1e-4;

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

/// Velocities after 1 s: the mean down the incline, and the greatest distance of a vertex's
/// velocity from the mean along the incline and across it.
struct Slide {
    double speed, uneven_speed, sideways_speed;
};

Slide slide_for_a_second(const Scene& scene) {
    World world = test::build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    for (int frame = 0; frame < 20; ++frame) {
        stepper.advance_frame(world, {});
    }
    Slide slide{};
    for (const Vec3& v : world.velocities) {
        slide.speed += v.x() / static_cast<double>(world.velocities.size());
    }
    for (const Vec3& v : world.velocities) {
        slide.uneven_speed = std::max(slide.uneven_speed, std::abs(v.x() - slide.speed));
        slide.sideways_speed = std::max(slide.sideways_speed, std::abs(v.z()));
    }
    return slide;
}

const double k_threshold_deg = std::atan(k_friction) * 180.0 / std::numbers::pi;

} // namespace

TEST(Incline, EachVertexSticksOrSlidesAsCoulombSays) {
    // The cloth sticks for tan(angle) < mu, else slides with g (sin - mu cos).
    for (const double degrees : {k_threshold_deg - 1.0, k_threshold_deg + 1.0, 30.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const Slide slide = slide_for_a_second(sheet_on_incline(degrees, 10)); // of 5 ms

        const double speed =
            std::max(0.0, k_gravity * (std::sin(angle) - k_friction * std::cos(angle)));
        EXPECT_NEAR(slide.speed, speed, 0.01 * speed + k_creep) << degrees;
        EXPECT_LT(slide.uneven_speed, 0.01 * speed + k_creep) << degrees;
        EXPECT_LT(slide.sideways_speed, k_creep) << degrees;
    }
}

} // namespace weft
