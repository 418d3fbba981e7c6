#include "base/parallel.h"
#include "collide/contact.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

using namespace test;

FabricParams fabric(double friction, double thickness = 2e-3) {
    FabricParams result;
    result.friction = friction;
    result.thickness = thickness;
    return result;
}

/// Sheet dropped onto a sphere above a floor; returns the states after each substep's hash input.
World sheet_over_sphere(int cells, int steps, ContactReport* worst = nullptr) {
    World world;
    add_sheet(world, cells, 1.0, 0.32, fabric(0.3));
    add_sphere(world, 0.3, Vec3::Zero());
    add_floor(world, 4.0, -0.5);
    ContactSolver solver(world, {});
    for (int i = 0; i < steps; ++i) {
        const ContactReport report = step(world, solver, 0.005, {.spring = 0.05 / cells * 200});
        if (worst) {
            worst->unresolved = std::max(worst->unresolved, report.unresolved);
            worst->scaled_islands = std::max(worst->scaled_islands, report.scaled_islands);
            worst->zones += report.zones > 0;
            worst->contacts_obstacle = std::max(worst->contacts_obstacle, report.contacts_obstacle);
            worst->contacts_self = std::max(worst->contacts_self, report.contacts_self);
            worst->min_gap = std::min(worst->min_gap, report.min_gap);
        }
    }
    return world;
}

} // namespace

TEST(ContactSolver, SheetThatFallsOnAFloorComesToRestAtItsThickness) {
    World world;
    add_sheet(world, 8, 0.4, 0.05, fabric(0.3));
    add_floor(world, 2.0, 0.0);
    ContactSolver solver(world, {});

    for (int i = 0; i < 100; ++i) {
        const ContactReport report = step(world, solver, 0.005);
        ASSERT_EQ(report.unresolved, 0);
    }

    for (const Vec3& x : world.positions) {
        EXPECT_NEAR(x.y(), 2e-3, 1e-4);
    }
    EXPECT_LT(kinetic_energy(world), 1e-9);
}

TEST(ContactSolver, SheetOverASphereNeverCrosses) {
    ContactReport worst;

    const World world = sheet_over_sphere(24, 200, &worst);

    EXPECT_EQ(worst.unresolved, 0);
    EXPECT_GT(worst.contacts_obstacle, 0);
    EXPECT_GT(worst.min_gap, 1e-5);
    EXPECT_TRUE(find_crossings(world, 10).empty());
}

TEST(ContactSolver, ResultIsTheSameForAnyThreadCount) {
    set_thread_count(1);
    const World one = sheet_over_sphere(16, 100);
    set_thread_count(2);
    const World two = sheet_over_sphere(16, 100);
    set_thread_count(0);

    ASSERT_EQ(one.positions.size(), two.positions.size());
    for (std::size_t i = 0; i < one.positions.size(); ++i) {
        ASSERT_EQ(one.positions[i], two.positions[i]) << i;
        ASSERT_EQ(one.velocities[i], two.velocities[i]) << i;
    }
}

TEST(ContactSolver, TwoCollidingSheetsKeepTheirMomentum) {
    World world;
    add_sheet(world, 8, 0.4, 0.01, fabric(0.5));
    add_sheet(world, 7, 0.4, -0.01, fabric(0.5));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.5, 0.5);
    for (Vec3& v : world.velocities) {
        v = Vec3(noise(random), noise(random), noise(random));
    }
    for (Index i = 0; i < world.cloths[0].vertex_count; ++i) {
        world.velocities[static_cast<std::size_t>(i)].y() -= 4.0;
    }
    const Vec3 before = momentum(world);
    ContactSolver solver(world, {});

    int contacts = 0;
    for (int i = 0; i < 10; ++i) {
        const ContactReport report = step(world, solver, 0.002, {.gravity = Vec3::Zero()});
        contacts += report.contacts_self;
        EXPECT_EQ(report.unresolved, 0);
    }

    EXPECT_GT(contacts, 0);
    EXPECT_LT((momentum(world) - before).norm(), 1e-10);
}

TEST(ContactSolver, FastSphereDoesNotTunnelASheet) {
    World world;
    add_sheet(world, 16, 1.0, 0.0, fabric(0.3));
    Obstacle& ball = add_sphere(world, 0.1, {0.0, -0.3, 0.0}, 2);
    ball.params.motion = {{.t = 0.0}, {.t = 0.05, .translate = {0.0, 1.0, 0.0}}}; // 20 m/s
    ContactSolver solver(world, {});

    for (int i = 0; i < 12; ++i) {
        const ContactReport report =
            step(world, solver, 0.005, {.gravity = Vec3::Zero(), .spring = 5.0});
        ASSERT_EQ(report.unresolved, 0) << i;
        ASSERT_TRUE(find_crossings(world, 1).empty()) << i;
    }

    const auto middle = static_cast<std::size_t>(8 * 17 + 8);
    EXPECT_GT(world.positions[middle].y(), 0.7 + 0.1); // above the ball's top at y = 0.8
}

TEST(ContactSolver, FastGrowingSpikeDoesNotTunnelASheet) {
    // A ball whose upper half shoots up at 20 m/s, 0.1 m a substep, and is pulled back as fast.
    World world;
    add_sheet(world, 16, 1.0, 0.0, fabric(0.3));
    Obstacle& ball = add_sphere(world, 0.1, {0.0, -0.3, 0.0}, 2);
    const std::vector<Vec3> rest = ball.mesh.positions;
    ball.deformation =
        std::make_shared<Deformation>(rest.size(), 0, [rest](double t, std::span<Vec3> positions) {
            const double rise = 20.0 * std::min(t, 0.06 - t);
            for (std::size_t i = 0; i < rest.size(); ++i) {
                positions[i] = rest[i] + std::max(0.0, rest[i].y() / 0.1) * rise * Vec3::UnitY();
            }
        });
    ContactSolver solver(world, {});

    double highest = 0.0;
    for (int i = 0; i < 12; ++i) {
        const ContactReport report =
            step(world, solver, 0.005, {.gravity = Vec3::Zero(), .spring = 5.0});
        ASSERT_EQ(report.unresolved, 0) << i;
        ASSERT_TRUE(find_crossings(world, 1).empty()) << i;
        highest = std::max(highest, world.positions[8 * 17 + 8].y());
    }

    EXPECT_GT(highest, 0.4); // the tip reaches y = -0.2 + 0.6
}

TEST(ContactSolver, FrictionHoldsBelowItsLimitAndSlidesAboveIt) {
    // On a floor, gravity tilted by an angle: the cloth sticks for tan(angle) < mu, else slides
    // with g (sin - mu cos).
    const double mu = 0.3;
    for (const double angle : {std::atan(mu) - 0.0175, std::atan(mu) + 0.0175, 0.5236}) {
        World world;
        add_sheet(world, 6, 0.3, 2e-3, fabric(mu));
        add_floor(world, 20.0, 0.0).params.friction = mu;
        ContactSolver solver(world, {});
        const Vec3 gravity = 9.81 * Vec3(std::sin(angle), -std::cos(angle), 0.0);

        for (int i = 0; i < 200; ++i) {
            step(world, solver, 0.005, {.gravity = gravity});
        }

        const double speed = std::max(0.0, 9.81 * (std::sin(angle) - mu * std::cos(angle)));
        for (const Vec3& v : world.velocities) {
            EXPECT_NEAR(v.x(), speed, 0.01 * speed + 1e-6) << angle;
            EXPECT_NEAR(v.z(), 0.0, 1e-6);
        }
    }
}

TEST(ContactSolver, ClothThatStartsTooNearDoesNotJump) {
    World world;
    add_sheet(world, 6, 0.3, 1e-4, fabric(0.3)); // 1.9 mm too near
    add_floor(world, 2.0, 0.0);
    ContactSolver solver(world, {});

    double fastest = 0.0;
    for (int i = 0; i < 400; ++i) {
        step(world, solver, 0.001);
        for (const Vec3& v : world.velocities) {
            fastest = std::max(fastest, v.norm());
        }
    }

    EXPECT_LT(fastest, 0.05); // 20 1/s times 1.9 mm, and nothing on top
    EXPECT_NEAR(world.positions[0].y(), 2e-3, 1e-4);
}

TEST(ContactSolver, FlatClothAtRestHasNoContacts) {
    World world;
    add_sheet(world, 10, 0.01, 0.0, fabric(0.3)); // cells of 1 mm, thickness 2 mm
    ContactSolver solver(world, {});

    const ContactReport report = step(world, solver, 0.005, {.gravity = Vec3::Zero()});

    EXPECT_EQ(report.contacts_self, 0);
    EXPECT_EQ(report.impacts, 0);
    ASSERT_EQ(solver.warnings().size(), 1U);
    EXPECT_NE(solver.warnings()[0].find("sheet0"), std::string::npos);
}

} // namespace weft
