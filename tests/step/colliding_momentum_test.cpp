#include "step/advance.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

TEST(Stepper, SheetsThatCollideKeepTheirMomentumUnderBothIntegrators) {
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        Scene scene = test::scene_of(test::record_sheet(4));
        scene.scene.integrator = integrator;
        scene.scene.gravity.setZero();
        scene.scene.air_density = 0.0;
        scene.scene.solver_tolerance = 1e-13;
        scene.cloths[0].grid_size = Vec2(0.2, 0.2);
        ClothParams upper = scene.cloths[0];
        upper.name = "upper";
        upper.placement = {.translate = Vec3(0.02, 0.02, 0.01), .rotate_deg = Vec3(5.0, 20.0, 3.0)};
        upper.velocity = Vec3(0.2, -1.0, 0.0);
        scene.cloths.push_back(upper);
        World world = test::build_quietly(scene);
        Stepper stepper(world, scene.scene, scene.contact);
        const Vec3 before = test::momentum(world); // 0.008 kg at 1 m/s
        int contacts = 0;

        for (int frame = 0; frame < 3; ++frame) {
            contacts += stepper.advance_frame(world, nullptr)->contact.contacts_self;
        }

        EXPECT_GT(contacts, 0);
        EXPECT_LT((test::momentum(world) - before).norm(), 1e-12);
    }
}

} // namespace weft
