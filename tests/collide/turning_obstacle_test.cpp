#include "collide/contact.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

namespace weft {

TEST(TurningObstacle, DrivesWhatSticksAtADistanceWithItsMotionThere) {
    World world;
    FabricParams fabric;
    fabric.thickness = 2e-3;
    test::add_sheet(world, 4, 0.1, 1.5e-3, fabric);
    Obstacle& floor = test::add_floor(world, 1.0, 0.0);
    floor.params.motion = {{.t = 0.0}, {.t = 1.0, .rotate_deg = Vec3(20.0, 30.0, -40.0)}};
    const double dt = 0.02;
    const Mat3 turn = obstacle_pose(floor, dt).rotation;
    ContactSolver solver(world, {});
    std::vector<Contact> contacts;

    solver.find_contacts(world, std::vector<char>(world.vertex_count(), 0), dt, contacts);

    ASSERT_FALSE(contacts.empty());
    for (const Contact& contact : contacts) {
        Vec3 slip = contact.driven; // of a sheet that turns with the floor
        for (std::size_t i = 0; i < 4; ++i) {
            if (contact.vertices[i] != k_no_index) {
                const Vec3& x = world.positions[static_cast<std::size_t>(contact.vertices[i])];
                slip += contact.weights[i] * (turn * x - x);
            }
        }
        slip -= contact.normal.dot(slip) * contact.normal;
        EXPECT_LT(slip.norm(), 1e-15);
    }
}

} // namespace weft
