#include "step/advance.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

Scene small_sheet(Integrator integrator) {
    Scene scene = test::scene_of(test::record_sheet(6));
    scene.scene.integrator = integrator;
    scene.scene.air_density = 0.0;
    scene.cloths[0].grid_size = Vec2(0.2, 0.2);
    return scene;
}

} // namespace

TEST(Stepper, SheetsThatCollideKeepTheirMomentum) {
    Scene scene = small_sheet(Integrator::Euler);
    scene.scene.gravity.setZero();
    scene.scene.solver_tolerance = 1e-13;
    ClothParams upper = scene.cloths[0];
    upper.name = "upper";
    upper.placement = {.translate = Vec3(0.02, 0.02, 0.01), .rotate_deg = Vec3(5.0, 20.0, 3.0)};
    upper.velocity = Vec3(0.2, -1.0, 0.0);
    scene.cloths.push_back(upper);
    World world = test::build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    const Vec3 before = linear_momentum(world); // 0.008 kg at 1 m/s
    int contacts = 0;

    for (int frame = 0; frame < 3; ++frame) {
        contacts += stepper.advance_frame(world, nullptr)->contact.contacts_self;
    }

    EXPECT_GT(contacts, 0);
    EXPECT_LT((linear_momentum(world) - before).norm(), 1e-12);
}

TEST(Stepper, SheetThatFallsFlatComesToRestAtOnceUnderBothIntegrators) {
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        Scene scene = small_sheet(integrator);
        scene.cloths[0].grid_size = Vec2(0.6, 0.6);
        scene.cloths[0].grid_cells = {16, 16};
        scene.cloths[0].placement.translate = Vec3(0.0, 0.15, 0.0);
        scene.obstacles.push_back(
            {.name = "floor", .shape = Shape::Plane, .size = Vec3(2.0, 1.0, 2.0)});
        World world = test::build_quietly(scene);
        Stepper stepper({world, scene.scene, scene.contact});

        for (int frame = 0; frame < 10; ++frame) { // it lands in the fifth
            stepper.advance_frame(world, nullptr);
        }

        EXPECT_LT(kinetic_energy(world), 1e-6); // it arrived with 0.1 J
        EXPECT_NEAR(world.positions[0].y(), 1e-3, 2e-4);
    }
}

} // namespace weft
