#include "geometry/shapes.h"
#include "state/build_world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

/// Two cloths, a rigid body and an obstacle.
World some_world() {
    World world;
    const ImportedMesh sheet = imported(one_diagonal_sheet(2, 2, 1.0, 1.0));
    add_cloth(world, {.name = "first"}, sheet);
    add_cloth(world, {.name = "second"}, sheet);
    RigidParams ball{.name = "ball"};
    ball.shape = Shape::Sphere;
    ball.mass = 1.0;
    add_rigid(world, ball, {.mesh = sphere_mesh(0.1)});
    add_obstacle(world, {.name = "table"}, {.mesh = plane_mesh(Vec3(1.0, 0.0, 1.0))});
    return world;
}

} // namespace

TEST(World, IsWholeAfterEachBuilder) {
    EXPECT_EQ(check(some_world()), "");
}

TEST(World, CheckNamesTheFirstFault) {
    const World good = some_world();

    World world = good;
    world.previous_positions.pop_back();
    EXPECT_EQ(check(world), "arrays of vertices have unequal lengths");
    world = good;
    world.masses[3] = 0.0;
    EXPECT_EQ(check(world), "mass of vertex 3 is 0");
    world = good;
    world.cloths[1].triangles[0][2] = 9;
    EXPECT_EQ(check(world), "cloth 'second' has a triangle with vertex 9");
    world = good;
    world.rigids[0].body.first_particle = static_cast<Index>(world.vertex_count());
    EXPECT_EQ(check(world), "body 'ball' reaches past the world's vertices");
    world = good;
    world.pins.push_back({.vertex = -1, .group = 0});
    EXPECT_EQ(check(world), "pin 0 has vertex -1");
    world = good;
    world.velocities[5].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(check(world), "velocity of vertex 5 is not finite");
}

TEST(World, MeasuresLinearAndAngularMomentum) {
    World world = some_world();
    double mass = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.positions[i] += Vec3(0.0, 2.0, 0.0) - world.positions[i]; // all at one place
        world.velocities[i] = Vec3(3.0, 0.0, 0.0);
        mass += world.masses[i];
    }

    EXPECT_NEAR(linear_momentum(world).x(), 3.0 * mass, 1e-12);
    EXPECT_NEAR(speed_sum(world), 3.0 * mass, 1e-12);
    EXPECT_NEAR(angular_momentum(world).z(), -6.0 * mass, 1e-12); // (0, 2, 0) x (3, 0, 0)
    EXPECT_NEAR(kinetic_energy(world), 4.5 * mass, 1e-12);
}

} // namespace weft
