#include "base/parallel.h"
#include "step/force_system.h"
#include "support/changing_world.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

const SceneParams k_windy{.wind = {1.0, 0.0, 2.0}, .air_density = 1.2};

struct Assembled {
    std::vector<Vec3> forces, forces_alone;
    BlockMatrix matrix;
    std::vector<Index> row_of_vertex;
};

/// What a system says of a world.
Assembled assembled(ForceSystem& system, const World& world) {
    Assembled result;
    const std::size_t n = world.vertex_count();
    result.forces.resize(n);
    result.forces_alone.resize(n);
    system.start_substep(world.velocities);
    system.set_attachments(world, world.time + 0.01);
    system.evaluate(world.positions, world.velocities, {1e-4, 1e-2}, result.forces);
    result.matrix = system.assembler().pattern();
    system.assemble(world.masses, result.matrix);
    system.forces_only(world.positions, world.velocities, result.forces_alone);
    const auto rows = system.assembler().row_of_vertex();
    result.row_of_vertex.assign(rows.begin(), rows.end());
    return result;
}

void expect_same_bits(const Assembled& a, const Assembled& b) {
    ASSERT_EQ(a.row_of_vertex, b.row_of_vertex);
    ASSERT_EQ(a.matrix.row_begin, b.matrix.row_begin);
    ASSERT_EQ(a.matrix.column, b.matrix.column);
    ASSERT_EQ(a.matrix.diagonal, b.matrix.diagonal);
    ASSERT_TRUE(a.matrix.blocks == b.matrix.blocks);
    ASSERT_TRUE(a.forces == b.forces);
    ASSERT_TRUE(a.forces_alone == b.forces_alone);
}

} // namespace

TEST(ForceSystem, AfterAnyChangesIsTheOneMadeAfresh) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        ChangingWorld changing(3, seed);
        const World& world = changing.world();
        ForceSystem system(world, k_windy);
        for (int round = 0; round < 24; ++round) { // grows, then shrinks, then both at once
            const double growth = round < 8 ? 0.9 : round < 16 ? 0.0 : 0.5;
            const std::array<int, 3> edits{round % 4, round % 3 == 0 ? 0 : 9, 5};
            const auto changes = changing.change(edits, growth);

            system.adapt(world, changes);

            ForceSystem fresh(world, k_windy);
            expect_same_bits(assembled(system, world), assembled(fresh, world));
        }
    }
}

TEST(ForceSystem, ChangesWithoutAnEvaluationBetweenAreAllTakenUp) {
    ChangingWorld changing(2, 3);
    const World& world = changing.world();
    ForceSystem system(world, k_windy);
    const std::array<int, 2> edits{4, 9};
    for (int round = 0; round < 10; ++round) {
        system.adapt(world, changing.change(edits, 0.5));
    }

    ForceSystem fresh(world, k_windy);
    expect_same_bits(assembled(system, world), assembled(fresh, world));
}

TEST(ForceSystem, WithoutChangesStaysWhatItWas) {
    ChangingWorld changing(2, 5);
    ForceSystem system(changing.world(), k_windy);
    const Assembled before = assembled(system, changing.world());

    system.adapt(changing.world(), std::vector<ClothChanges>(2));

    expect_same_bits(assembled(system, changing.world()), before);
}

TEST(ForceSystem, IsTheSameForAnyNumberOfThreadsAfterChanges) {
    const auto after_changes = [](int threads) {
        set_thread_count(threads);
        ChangingWorld changing(2, 7);
        ForceSystem system(changing.world(), k_windy);
        for (int round = 0; round < 5; ++round) {
            const std::array<int, 2> edits{9, 9};
            system.adapt(changing.world(), changing.change(edits, 0.6));
        }
        Assembled result = assembled(system, changing.world());
        set_thread_count(0);
        return result;
    };

    expect_same_bits(after_changes(1), after_changes(3));
}

} // namespace weft
