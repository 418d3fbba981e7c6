#include "adapt/sqrt3_mesh.h"
#include "base/parallel.h"
#include "forces/constant_bending.h"
#include "step/force_system.h"
#include "support/adaptive_cloths.h"
#include "support/changing_sheet.h"
#include "support/changing_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

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

/// Cloths that refine and coarsen themselves, placed one above the other.
class RefinedWorld {
public:
    World world;

    RefinedWorld() {
        for (const int cells : {5, 4}) {
            world.cloths.push_back(adaptive_sheet(rough_sheet(cells, 0.2, 3)));
            world.cloths.back().params.fabric.damping = {0.1, 0.01};
        }
        for (const Cloth& cloth : world.cloths) {
            meshes_.emplace_back(cloth);
        }
        place_vertices();
    }

    /// @param share of the edits that refine
    std::vector<ClothChanges> change(int edits, double share) {
        std::vector<ClothChanges> changes;
        for (std::size_t c = 0; c < world.cloths.size(); ++c) {
            Cloth& cloth = world.cloths[c];
            meshes_[c].begin(cloth, {}, {.max_level = 4});
            for (int i = 0; i < edits; ++i) {
                const auto refine = std::bernoulli_distribution(share)(random_);
                const std::size_t slots =
                    refine ? cloth.triangles.size() : static_cast<std::size_t>(cloth.vertex_count);
                const auto slot = static_cast<Index>(random_() % slots);
                if (refine && cloth.triangles[static_cast<std::size_t>(slot)][0] != k_no_index) {
                    meshes_[c].refine(slot);
                } else if (!refine && meshes_[c].can_remove(slot)) {
                    meshes_[c].remove(slot);
                }
            }
            changes.push_back(meshes_[c].finish());
        }
        place_vertices();
        return changes;
    }

    bool is_imported() const {
        return std::ranges::all_of(world.cloths,
                                   [](const Cloth& c) { return c.refinement.vertices.empty(); });
    }

private:
    void place_vertices() {
        world.positions.clear();
        world.velocities.clear();
        world.masses.clear();
        for (Cloth& cloth : world.cloths) {
            cloth.first_vertex = static_cast<Index>(world.positions.size());
            for (std::size_t i = 0; i < cloth.material_positions.size(); ++i) {
                const Vec2& m = cloth.material_positions[i];
                world.positions.emplace_back(1.02 * m.x(), std::sin(9.0 * m.x()), m.y());
                world.velocities.emplace_back(m.x() * m.y(), std::cos(9.0 * m.x()), m.y());
                world.masses.push_back(0.2 * cloth.rest_areas[i]);
            }
        }
    }

    std::vector<Sqrt3Mesh> meshes_;
    std::mt19937 random_{5};
};

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

            system.remesh(world, changes);

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
        system.remesh(world, changing.change(edits, 0.5));
    }

    ForceSystem fresh(world, k_windy);
    expect_same_bits(assembled(system, world), assembled(fresh, world));
}

TEST(ForceSystem, WithoutChangesStaysWhatItWas) {
    ChangingWorld changing(2, 5);
    ForceSystem system(changing.world(), k_windy);
    const Assembled before = assembled(system, changing.world());

    system.remesh(changing.world(), std::vector<ClothChanges>(2));

    expect_same_bits(assembled(system, changing.world()), before);
}

TEST(ForceSystem, IsTheSameForAnyNumberOfThreadsAfterChanges) {
    const auto after_changes = [](int threads) {
        set_thread_count(threads);
        ChangingWorld changing(2, 7);
        ForceSystem system(changing.world(), k_windy);
        for (int round = 0; round < 5; ++round) {
            const std::array<int, 2> edits{9, 9};
            system.remesh(changing.world(), changing.change(edits, 0.6));
        }
        Assembled result = assembled(system, changing.world());
        set_thread_count(0);
        return result;
    };

    expect_same_bits(after_changes(1), after_changes(3));
}

TEST(ForceSystem, RefinedAndCoarsenedIsTheOneMadeAfresh) {
    RefinedWorld refined;
    const World& world = refined.world;
    ForceSystem system(world, k_windy);
    const Assembled imported = assembled(system, world);
    for (int round = 0; round < 30; ++round) {
        const auto changes = refined.change(6, round < 15 ? 0.8 : 0.3);

        system.remesh(world, changes);

        ForceSystem fresh(world, k_windy);
        expect_same_bits(assembled(system, world), assembled(fresh, world));
    }
    for (int round = 0; round < 500 && !refined.is_imported(); ++round) {
        system.remesh(world, refined.change(100, 0.0));
    }

    ASSERT_TRUE(refined.is_imported());
    expect_same_bits(assembled(system, world), imported);
}

TEST(ForceSystem, VertexAtTwoNodesOfAnElementGetsBothBlocks) {
    // All three neighbours of a triangle that was split in three have the same apex in pairs.
    ChangingSheet sheet({.points = {{0.0, 0.0}, {1.0, 0.0}, {0.3, 0.9}, {0.4, 0.3}},
                         .triangles = {{3, 0, 1}, {3, 1, 2}, {3, 2, 0}}},
                        {.bend_stiffness = 1.0}, BendModel::MidEdge, 1);
    const ConstantBending bending(sheet.cloth());
    const std::vector<VertexRange> objects{{0, 4}};
    const std::vector<ElementSet> sets{{6, bending.nodes(), 0, true, bending.stiffness()}};
    const Assembler assembler(objects, sets);
    const std::vector<Vec3> x{{0.0, 0.1, 0.0}, {1.0, 0.2, 0.1}, {0.4, -0.2, 0.9}, {0.4, 0.3, 0.3}};
    std::vector<Vec3> element_forces(assembler.force_count()), forces(4), product(4), by_row(4);
    bending.forces(x, element_forces);
    assembler.gather_forces(element_forces, forces);
    BlockMatrix matrix = assembler.pattern();
    const std::vector<double> nothing(4, 0.0);

    assembler.assemble({}, 1.0, nothing, matrix);

    for (std::size_t v = 0; v < 4; ++v) {
        by_row[static_cast<std::size_t>(assembler.row_of_vertex()[v])] = x[v];
    }
    multiply(matrix, by_row, product);
    for (std::size_t v = 0; v < 4; ++v) { // f = -Q x
        const Vec3& row = product[static_cast<std::size_t>(assembler.row_of_vertex()[v])];
        EXPECT_LT((row + forces[v]).norm(), 1e-12 * forces[v].norm());
    }
}

} // namespace weft
