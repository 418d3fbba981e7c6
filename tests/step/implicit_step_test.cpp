#include "base/parallel.h"
#include "forces/cloth_forces.h"
#include "step/constrained_vertices.h"
#include "step/implicit_step.h"
#include "support/changing_world.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// Advances a world without contact.
void run(World& world, const SceneParams& params, double dt, int substeps) {
    ImplicitStep step(world, params);
    ConstrainedVertices constrained;
    std::vector<Vec3> positions, velocities;
    for (int i = 0; i < substeps; ++i) {
        find_constrained(world, world.time + dt, constrained);
        ASSERT_TRUE(step.solve(world, constrained, dt, positions, velocities).converged);
        std::swap(world.previous_positions, world.positions);
        std::swap(world.previous_velocities, world.velocities);
        world.positions = positions;
        world.velocities = velocities;
        world.history_dt = params.integrator == Integrator::Bdf2 ? dt : 0.0;
        world.time += dt;
    }
}

/// A sheet in vacuum without gravity.
Scene free_sheet(int cells) {
    Scene scene = test::scene_of(test::record_sheet(cells));
    scene.scene.air_density = 0.0;
    scene.scene.gravity.setZero();
    scene.scene.solver_tolerance = 1e-12;
    return scene;
}

/// Stretches and shakes every vertex at random.
void disturb(World& world, double size, double speed) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.positions[i] += size * Vec3(normal(random), normal(random), normal(random));
        world.velocities[i] += speed * Vec3(normal(random), normal(random), normal(random));
    }
}

} // namespace

TEST(ImplicitStep, FreeFallIsTheSumOfImplicitEuler) {
    Scene scene = free_sheet(6);
    scene.scene.gravity = Vec3(0.0, -9.81, 0.0);
    World world = test::build_quietly(scene);
    const std::vector<Vec3> start = world.positions;
    constexpr double dt = 0.01;
    constexpr int n = 30;

    run(world, scene.scene, dt, n);

    for (std::size_t i = 0; i < world.vertex_count(); ++i) { // x0 - g h^2 n (n + 1) / 2
        const Vec3 fall = world.positions[i] - start[i];
        EXPECT_NEAR(fall.y(), -9.81 * dt * dt * n * (n + 1) / 2.0, 1e-12);
        EXPECT_LT(std::hypot(fall.x(), fall.z()), 1e-12);
        EXPECT_NEAR(world.velocities[i].y(), -9.81 * dt * n, 1e-12);
    }
}

TEST(ImplicitStep, LinearMomentumIsKeptByBothIntegrators) {
    for (const Integrator integrator : {Integrator::Euler, Integrator::Bdf2}) {
        Scene scene = free_sheet(8);
        scene.scene.integrator = integrator;
        scene.cloths[0].fabric.damping = {0.0, 1e-3};
        World world = test::build_quietly(scene);
        disturb(world, 2e-3, 1.0);
        const Vec3 before = linear_momentum(world);

        run(world, scene.scene, 0.005, 20);

        EXPECT_LT((linear_momentum(world) - before).norm(), 1e-11);
    }
}

TEST(ImplicitStep, HeldVerticesArriveExactlyWhereTheyAreTaken) {
    Scene scene = test::scene_of(test::record_sheet(8));
    scene.cloths[0].pins.push_back(
        {.vertices = {0, 8}, .move = {{0.0, 0.0, 0.0, 0.0}, {0.1, 0.02, 0.0, 0.01}}});
    World world = test::build_quietly(scene);
    const Vec3 start = world.positions[8];

    run(world, scene.scene, 0.01, 10);

    EXPECT_LT((world.positions[8] - start - Vec3(0.02, 0.0, 0.01)).norm(), 1e-15);
    EXPECT_LT((world.velocities[8] - Vec3(0.2, 0.0, 0.1)).norm(), 1e-12);
}

TEST(ImplicitStep, PinLetsGoAtItsTime) {
    Scene scene = test::scene_of(test::record_sheet(4));
    scene.cloths[0].pins.push_back({.vertices = {0}, .until = 0.05});
    World world = test::build_quietly(scene);
    const Vec3 start = world.positions[0];

    run(world, scene.scene, 0.01, 5);
    EXPECT_EQ(world.positions[0], start);
    run(world, scene.scene, 0.01, 5);

    EXPECT_LT(world.positions[0].y(), start.y() - 1e-3);
}

TEST(ImplicitStep, StretchedSheetInVacuumLosesEnergyOnly) {
    Scene scene = free_sheet(8);
    scene.scene.newton = 20;
    World world = test::build_quietly(scene);
    disturb(world, 2e-3, 0.2);
    const auto total = [&] {
        return kinetic_energy(world) + elastic_energy(world.cloths[0], world.positions);
    };
    double before = total();

    for (int i = 0; i < 20; ++i) {
        run(world, scene.scene, 0.005, 1);
        const double after = total();
        EXPECT_LE(after, before * (1.0 + 1e-9));
        before = after;
    }
}

TEST(ImplicitStep, GivesTheSameBitsForAnyThreadCount) {
    Scene scene = test::scene_of(test::record_sheet(40));
    scene.cloths[0].pins.push_back({.vertices = {0, 40}});
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        World world = test::build_quietly(scene);
        run(world, scene.scene, 0.01, 5);
        hashes.push_back(state_hash(world));
    }
    set_thread_count(0);

    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(ImplicitStep, AfterChangesOfTheMeshStepsAsOneMadeAfresh) {
    test::ChangingWorld changing(2, 4);
    World& world = changing.world();
    const SceneParams params;
    ImplicitStep adapted(world, params);
    for (int round = 0; round < 6; ++round) {
        const auto solve = [&](ImplicitStep& step) {
            ConstrainedVertices constrained;
            find_constrained(world, world.time + 0.01, constrained);
            Contact contact{.vertices = {0, 1, 2, world.cloths[1].first_vertex},
                            .weights = {-0.2, -0.3, -0.5, 1.0},
                            .normal = Vec3::UnitY(),
                            .thickness = 0.2};
            std::vector<Vec3> positions, velocities;
            std::span<Contact> contacts(&contact, static_cast<std::size_t>(round % 2));
            EXPECT_TRUE(
                step.solve(world, constrained, 0.01, positions, velocities, contacts).converged);
            positions.insert(positions.end(), velocities.begin(), velocities.end());
            return positions;
        };
        solve(adapted);
        const std::array<int, 2> edits{6, 6};

        adapted.remesh(world, changing.change(edits, round < 3 ? 0.9 : 0.2));

        ImplicitStep fresh(world, params);
        ASSERT_TRUE(solve(adapted) == solve(fresh));
    }
}

} // namespace weft
