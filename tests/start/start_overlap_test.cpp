#include "base/error.h"
#include "start/start_overlap.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A napkin whose middle is 10 mm below the top of a ball of 0.2 m.
Scene napkin_in_ball(StartOverlap way) {
    ClothParams napkin = test::record_sheet(20);
    napkin.name = "napkin";
    napkin.grid_size = {0.6, 0.6};
    napkin.placement.translate = {0.0, 0.19, 0.0};
    ObstacleParams ball;
    ball.name = "ball";
    ball.shape = Shape::Sphere;
    ball.radius = 0.2;
    Scene scene = test::scene_of(napkin);
    scene.obstacles.push_back(ball);
    scene.contact.start_overlap = way;
    return scene;
}

std::optional<StartOverlapReport> cure(World& world, const Scene& scene) {
    return cure_start_overlap(world, scene, [] { return false; });
}

} // namespace

TEST(StartOverlap, IsRefusedNamingPairsCountPlaceAndRemedies) {
    const Scene scene = napkin_in_ball(StartOverlap::Error);
    World world = test::build_quietly(scene);
    const std::size_t count = find_crossings(world, 100000).size();

    try {
        cure(world, scene);
        FAIL() << "not refused";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        for (const std::string& words :
             {std::string("napkin: triangle "), std::string(" crosses ball triangle "),
              std::string(" m"), std::to_string(count) + " pairs cross at the start",
              std::string("\"untangle\""), std::string("\"grow\"")}) {
            EXPECT_NE(text.find(words), std::string::npos) << words << " is not in " << text;
        }
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
}

TEST(StartOverlap, IsUntangledAndKeepsRestShapeAndVelocity) {
    Scene scene = napkin_in_ball(StartOverlap::Untangle);
    scene.cloths[0].velocity = {0.1, 0.0, 0.0};
    World world = test::build_quietly(scene);
    const World before = world;

    const auto report = cure(world, scene);

    ASSERT_TRUE(report);
    EXPECT_GT(report->pairs_before, 20U);
    EXPECT_GT(report->rounds, 0);
    EXPECT_GT(report->max_displacement, 0.01);
    EXPECT_TRUE(find_crossings(world, 1).empty());
    EXPECT_EQ(world.velocities, before.velocities);
    EXPECT_EQ(world.previous_positions, world.positions);
    EXPECT_EQ(world.time, 0.0);
    for (std::size_t t = 0; t < world.cloths[0].rest.size(); ++t) {
        EXPECT_EQ(world.cloths[0].rest[t].inverse_edges, before.cloths[0].rest[t].inverse_edges);
    }
}

TEST(StartOverlap, PinsHoldTheirVerticesWhereUntanglingPutThem) {
    Scene scene = napkin_in_ball(StartOverlap::Untangle);
    PinParams middle;
    middle.has_box = true;
    middle.box_min = {-0.05, 0.0, -0.05};
    middle.box_max = {0.05, 1.0, 0.05};
    middle.to = "ball";
    scene.cloths[0].pins.push_back(middle);
    World world = test::build_quietly(scene);

    cure(world, scene);

    ASSERT_GE(world.pins.size(), 9U);
    for (const Pin& pin : world.pins) {
        const Vec3& x = world.positions[static_cast<std::size_t>(pin.vertex)];
        const Vec3 held = pin_position(pin, world.pin_groups[0], world.obstacles, 0.0);
        EXPECT_LT((held - x).norm(), 1e-12);
        EXPECT_GT(x.norm(), 0.199);
    }
}

TEST(StartOverlap, OfClothWithClothIsNoneWhereContactLeavesThemAlone) {
    Scene scene = test::scene_of(test::record_sheet(8));
    scene.cloths.push_back(test::record_sheet(7));
    scene.cloths[1].name = "second";
    scene.cloths[1].placement.rotate_deg = {0.0, 0.0, 40.0};
    World world = test::build_quietly(scene);
    EXPECT_THROW(cure(world, scene), Error);

    scene.contact.self = false;

    EXPECT_TRUE(crossings_of_contact(world, scene.contact).empty());
    EXPECT_EQ(cure(world, scene)->pairs_before, 0U);
}

TEST(StartOverlap, ThatCannotBeCuredIsNamed) {
    // two boxes that overlap by 0.1 m leave the sheet between them no place within metres
    Scene scene = napkin_in_ball(StartOverlap::Untangle);
    scene.cloths[0].placement = {.rotate_deg = {0.0, 0.0, 30.0}};
    for (const double side : {-1.0, 1.0}) {
        ObstacleParams box;
        box.name = side < 0.0 ? "below" : "above";
        box.shape = Shape::Box;
        box.size = {10.0, 1.0, 10.0};
        box.placement.translate = {0.0, 0.45 * side, 0.0};
        scene.obstacles.push_back(box);
    }
    scene.obstacles.erase(scene.obstacles.begin());
    World world = test::build_quietly(scene);

    try {
        cure(world, scene);
        FAIL() << "there is no place for it";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("could not part"), std::string::npos) << text;
        EXPECT_NE(text.find("crosses"), std::string::npos) << text;
    }
}

TEST(StartOverlap, IsPushedApartByObstaclesThatGrow) {
    const Scene scene = napkin_in_ball(StartOverlap::Grow);
    World world = test::build_quietly(scene);
    const World before = world;

    const auto report = cure(world, scene);

    ASSERT_TRUE(report);
    EXPECT_TRUE(find_crossings(world, 1).empty());
    EXPECT_GE(report->deepest_inset, 0.01); // the napkin was 10 mm deep
    EXPECT_GT(report->preroll_substeps, 10);
    EXPECT_EQ(world.velocities, before.velocities);
    EXPECT_EQ(world.time, 0.0);
    EXPECT_EQ(world.frame, 1);
    EXPECT_EQ(world.obstacles[0].mesh.positions, before.obstacles[0].mesh.positions);
    for (std::size_t v = 0; v < world.vertex_count(); ++v) {
        EXPECT_GT(world.positions[v].norm(), 0.199); // outside of a ball of 0.2 m
    }
}

/// Objects are listed as cloths, solids, rigid bodies, obstacles: none of them must be taken for
/// another one.
TEST(StartOverlap, ObstaclesGrowBesideASolidOrARigidBodyAsWithoutIt) {
    const Scene alone = napkin_in_ball(StartOverlap::Grow);
    Scene with_solid = alone;
    SolidParams solid;
    solid.name = "cube";
    solid.box = Vec3(0.1, 0.1, 0.1);
    solid.spacing = 0.05;
    solid.placement.translate = {3.0, 0.0, 0.0};
    with_solid.solids.push_back(solid);
    Scene with_rigid = alone;
    RigidParams rigid;
    rigid.name = "block";
    rigid.shape = Shape::Box;
    rigid.size = Vec3(0.1, 0.1, 0.1);
    rigid.placement.translate = {3.0, 0.0, 0.0};
    with_rigid.rigids.push_back(rigid);
    World world = test::build_quietly(alone);
    const auto expected = cure(world, alone);
    ASSERT_TRUE(expected);
    EXPECT_NEAR(expected->deepest_inset, 0.0114, 0.0001); // 1 mm times 1.5^6

    for (const Scene& scene : {with_solid, with_rigid}) {
        World beside = test::build_quietly(scene);
        const auto report = cure(beside, scene);

        ASSERT_TRUE(report);
        EXPECT_EQ(report->deepest_inset, expected->deepest_inset);
        EXPECT_EQ(report->preroll_substeps, expected->preroll_substeps);
        EXPECT_TRUE(find_crossings(beside, 1).empty());
    }
}

TEST(StartOverlap, GrowingLeavesMotionAndGravityOfTheSceneForLater) {
    Scene scene = napkin_in_ball(StartOverlap::Grow);
    scene.scene.gravity = {0.0, -1000.0, 0.0};
    scene.obstacles[0].motion = {{.t = 0.0}, {.t = 0.1, .translate = {1.0, 0.0, 0.0}}};
    World world = test::build_quietly(scene);

    cure(world, scene);

    Vec3 mean = Vec3::Zero();
    for (const Vec3& x : world.positions) {
        mean += x / static_cast<double>(world.vertex_count());
    }
    EXPECT_NEAR(mean.x(), 0.0, 1e-3); // the ball did not carry it off
    EXPECT_GT(mean.y(), 0.18);        // 10 m would have been fallen in 0.15 s
}

TEST(StartOverlap, GrowingStopsWhenAsked) {
    const Scene scene = napkin_in_ball(StartOverlap::Grow);
    World world = test::build_quietly(scene);

    EXPECT_FALSE(cure_start_overlap(world, scene, [] { return true; }));
}

TEST(StartOverlap, OfClothWithClothIsUntangledBeforeObstaclesGrow) {
    Scene scene = napkin_in_ball(StartOverlap::Grow);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    scene.cloths[1].layer = 1;
    scene.cloths[1].placement.rotate_deg = {0.0, 10.0, 2.0};
    World world = test::build_quietly(scene);

    const auto report = cure(world, scene);

    EXPECT_GT(report->rounds, 0);
    EXPECT_TRUE(find_crossings(world, 1).empty());
}

} // namespace weft
