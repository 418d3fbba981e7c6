#include "collide/crossings.h"
#include "step/advance.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// A box that comes to y = 0 from one side, goes on by a tenth of its size, and back again.
ObstacleParams closing_box(const std::string& name, double side) {
    ObstacleParams box{.name = name, .shape = Shape::Box, .size = Vec3(0.1, 0.1, 0.1)};
    box.placement.translate = Vec3(0.003, side * 0.07, 0.002);
    box.motion = {{.t = 0.0}, {.t = 0.4, .translate = Vec3(0.0, side * -0.025, 0.0)}, {.t = 0.8}};
    return box;
}

} // namespace

TEST(Pinch, IsCountedWhereObstaclesLeaveNoRoomAndHealsWhenTheyPart) {
    ClothParams sheet = test::record_sheet(12);
    sheet.grid_size = Vec2(0.2, 0.2);
    sheet.placement.rotate_deg = Vec3(1.0, 0.0, 2.0);
    sheet.pins = {{.corners = true}};
    Scene scene = test::scene_of(sheet);
    scene.obstacles = {closing_box("above", 1.0), closing_box("below", -1.0)};
    World world = test::build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});

    int greatest = 0;
    double fastest = 0.0;
    for (int frame = 0; frame < 24; ++frame) {
        const auto report = stepper.advance_frame(world, nullptr);
        greatest = std::max(greatest, report->contact.unresolved);
        if (report->contact.unresolved == 0) {
            EXPECT_TRUE(find_crossings(world, 1).empty()) << frame;
        }
        for (const Vec3& v : world.velocities) {
            fastest = std::max(fastest, v.norm());
        }
    }

    EXPECT_GT(greatest, 0); // the boxes overlap by 10 mm at 0.4 s
    EXPECT_LT(fastest, 1.0);
    EXPECT_TRUE(find_crossings(world, 1).empty());
}

} // namespace weft
