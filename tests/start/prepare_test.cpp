#include "start/prepare.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A napkin that may be refined, 10 mm deep in the top of a ball of 0.2 m.
Scene napkin_in_ball(StartOverlap cure, int levels) {
    ClothParams napkin = test::record_sheet(20);
    napkin.grid_size = {0.6, 0.6};
    napkin.placement.translate = {0.0, 0.19, 0.0};
    napkin.adapt.levels = levels;
    Scene scene = test::scene_of(napkin);
    scene.obstacles.push_back({.name = "ball", .shape = Shape::Sphere, .radius = 0.2});
    scene.contact.start_overlap = cure;
    return scene;
}

Prepared prepared(const Scene& scene) {
    return prepare(scene, [](const std::string& line) { ADD_FAILURE() << line; });
}

} // namespace

TEST(Prepare, CuresOverlapBeforeItMakesClothAdaptive) {
    const Scene scene = napkin_in_ball(StartOverlap::Untangle, 2);

    const Prepared start = prepared(scene);

    EXPECT_TRUE(crossings_of_contact(start.world(), scene.contact).empty());
    EXPECT_EQ(start.world().cloths[0].refinement.start, start.world().positions);
    EXPECT_NE(start.world().positions, test::build_quietly(scene).positions);
}

TEST(Prepare, ObstaclesGrowIntoTheImportedMeshOfClothThatIsToBeRefined) {
    const Prepared plain = prepared(napkin_in_ball(StartOverlap::Grow, 0));
    const Prepared refining = prepared(napkin_in_ball(StartOverlap::Grow, 2));

    EXPECT_EQ(refining.world().positions, plain.world().positions);
    EXPECT_TRUE(plain.world().cloths[0].refinement.empty());
    EXPECT_FALSE(refining.world().cloths[0].refinement.empty());
}

TEST(Prepare, GivesNothingWhenAskedToStop) {
    const Scene scene = napkin_in_ball(StartOverlap::Grow, 0);

    EXPECT_FALSE(prepare(test::build_quietly(scene), scene, [] { return true; }));
}

} // namespace weft
