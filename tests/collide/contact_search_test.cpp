#include "collide/contact_search.h"
#include "collide/contact_solver.h"
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
        Vec3 slip = contact.obstacle_displacement; // of a sheet that turns with the floor
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

TEST(Proximity, VertexOverAFaceIsNotHeldByTheFaceBeside) {
    // A vertex over one triangle of a flat floor, nearer to the diagonal than its thickness.
    World world;
    FabricParams fabric;
    fabric.thickness = 2e-3;
    test::add_sheet(world, 1, 0.1, 0.0, fabric);
    test::add_floor(world, 1.0, 0.0);
    ContactSurface surface = make_surface(world);
    place_surface(surface, world, std::vector<Vec3>(4, Vec3::Zero()), std::vector<char>(4, 0),
                  0.01);
    surface.start[0] = Vec3(0.101, 2e-3, 0.1); // the diagonal is x = z
    const auto is_nearest = [&](Index triangle) {
        const Triangle& t = surface.triangles[static_cast<std::size_t>(triangle)];
        const Candidate candidate{.vertices = {0, t[0], t[1], t[2]},
                                  .triangles = {triangle, triangle},
                                  .rule = surface.rule_of(0, t[0]),
                                  .kind = PairKind::VertexFace};
        return is_nearest_here(
            surface, candidate,
            separation(PairKind::VertexFace, start_points(surface, candidate.vertices)));
    };

    EXPECT_NE(is_nearest(2), is_nearest(3)); // one of the floor's two triangles, not both
}

} // namespace weft
