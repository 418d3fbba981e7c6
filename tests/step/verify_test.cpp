#include "collide/crossings.h"
#include "step/advance.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A sheet of 0.2 m that flies down at 50 m/s, 0.1 m a substep, about a rod of 0.3 m: within a
/// frame it stands across the rod after substeps 4, 5 and 6, at 0.13, 0.03 and -0.07 m.
Scene sheet_about_a_rod() {
    Scene scene = test::scene_of(test::record_sheet(6));
    scene.scene.gravity.setZero();
    scene.scene.air_density = 0.0;
    scene.scene.substeps = 20;
    scene.cloths[0].grid_size = Vec2(0.2, 0.2);
    scene.cloths[0].placement.translate = Vec3(0.005, 0.53, 0.003);
    scene.cloths[0].velocity = Vec3(0.0, -50.0, 0.0);
    scene.obstacles.push_back({.name = "rod", .shape = Shape::Box, .size = Vec3(0.05, 0.3, 0.05)});
    return scene;
}

} // namespace

TEST(Verify, FindsCrossingsThatAreGoneAtTheFrame) {
    Scene scene = sheet_about_a_rod();
    scene.contact.enabled = false;
    World world = test::build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    stepper.verify_substeps(world);

    const FrameReport report = *stepper.advance_frame(world, nullptr);

    EXPECT_TRUE(find_crossings(world, 1).empty());
    ASSERT_GT(report.crossings, 0);
    ASSERT_GE(report.problems.size(), static_cast<std::size_t>(report.crossings));
    double last = 0.0;
    for (const UnresolvedPair& problem : report.problems) {
        EXPECT_GT(problem.time, 3.5 * 0.002);
        EXPECT_NEAR(problem.place.y(), 0.53 - 50.0 * problem.time, 1e-9);
        last = std::max(last, problem.time);
        EXPECT_EQ(problem.objects,
                  (std::array<ObjectId, 2>{{{ObjectKind::Cloth, 0}, {ObjectKind::Obstacle, 0}}}));
        EXPECT_EQ(problem.fault, PairFault::Crossing);
    }
    EXPECT_NEAR(last, 6 * 0.002, 1e-12);
}

TEST(Verify, TellsOfEachPairOnce) {
    Scene scene = sheet_about_a_rod();
    scene.contact.enabled = false;
    World world = test::build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    stepper.verify_substeps(world);

    const FrameReport report = *stepper.advance_frame(world, nullptr);

    ASSERT_GT(report.problems.size(), 1U);
    for (std::size_t i = 1; i < report.problems.size(); ++i) {
        EXPECT_LT(report.problems[i - 1].triangles, report.problems[i].triangles);
    }
}

TEST(Verify, FindsNothingWhereContactWorks) {
    const Scene scene = sheet_about_a_rod();
    World world = test::build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    stepper.verify_substeps(world);

    const FrameReport report = *stepper.advance_frame(world, nullptr);

    EXPECT_GT(report.contact.contacts_obstacle, 0);
    EXPECT_EQ(report.crossings, 0);
    EXPECT_TRUE(report.problems.empty());
    EXPECT_GT(report.substeps_impacts, 0);
    EXPECT_LE(report.substeps_impacts, report.substeps);
}

TEST(Verify, ChangesNothingThatIsSimulated) {
    const Scene scene = sheet_about_a_rod();
    World plain = test::build_quietly(scene);
    World verified = plain;
    Stepper stepper({plain, scene.scene, scene.contact});
    Stepper verifying({verified, scene.scene, scene.contact});
    verifying.verify_substeps(verified);

    const FrameReport without = *stepper.advance_frame(plain, nullptr);
    verifying.advance_frame(verified, nullptr);

    EXPECT_EQ(without.seconds.verify, 0.0);
    EXPECT_EQ(plain.positions, verified.positions);
}

} // namespace weft
