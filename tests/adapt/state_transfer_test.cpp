#include "adapt/state_transfer.h"
#include "support/adapting_world.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

using test::AdaptingWorld;
using test::SheetMotion;

constexpr std::array k_motions{SheetMotion::Spin, SheetMotion::Wave, SheetMotion::Crumple};

Vec3 centre_of(const Cloth& cloth) {
    return cloth.params.placement.translate;
}

long double mass_of(const World& world, const Cloth& cloth) {
    long double mass = 0.0L;
    for (Index v = cloth.first_vertex; v < cloth.first_vertex + cloth.vertex_count; ++v) {
        mass += world.masses[at(v)];
    }
    return mass;
}

double kinetic_energy(const World& world, const Cloth& cloth) {
    return test::momentum_of(world, cloth, Vec3::Zero()).kinetic;
}

/// Where each vertex with a name stands.
std::map<int, std::size_t> places_of(const std::vector<int>& names) {
    std::map<int, std::size_t> places;
    for (std::size_t i = 0; i < names.size(); ++i) {
        places[names[i]] = i;
    }
    return places;
}

/// Random adaptations of the world's first and last cloth, more refining than coarsening at first;
/// `look` is called after each with world and names before and the number of the cloth.
template <typename Look> void run_history(AdaptingWorld& sheets, const Look& look) {
    for (int i = 0; i < 12 && !testing::Test::HasFailure(); ++i) {
        const std::size_t index = i % 2 == 0 ? 0 : 2;
        const World before = sheets.world;
        const std::vector<int> names = sheets.names();
        sheets.adapt(index, 30, i < 8 ? 0.8 : 0.3);
        look(before, names, index);
    }
}

TEST(StateTransfer, KeepsMassAndBothMomentaOfEachCloth) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        run_history(sheets, [&](const World& before, auto&, std::size_t) {
            for (std::size_t c = 0; c < before.cloths.size(); ++c) {
                const Cloth& old_cloth = before.cloths[c];
                const Cloth& cloth = sheets.world.cloths[c];
                const Vec3 about = centre_of(cloth);
                const PatchMomentum old = test::momentum_of(before, old_cloth, about);
                const PatchMomentum now = test::momentum_of(sheets.world, cloth, about);
                const double scale = std::sqrt(2.0 * old.mass * old.kinetic);
                const auto mass = mass_of(before, old_cloth);
                EXPECT_LE(std::abs(mass_of(sheets.world, cloth) / mass - 1.0L), 1e-15L);
                EXPECT_LE((now.linear - old.linear).norm(), 1e-12 * scale);
                EXPECT_LE((now.angular - old.angular).norm(), 1e-12 * scale); // within 1 m
            }
        });
    }
}

/// Lumped masses nearer to the axis: with the same angular momentum it must turn faster, as a
/// skater does who draws in her arms; and slower when they go back.
TEST(StateTransfer, GivesBackTheEnergyThatASpinTakesUp) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        const World start = sheets.world;

        run_history(sheets, [&](const World& before, auto&, std::size_t index) {
            // a sheet of n x n cells: the inertia of a cell about its own middle, twice
            const double cells = index == 0 ? 6.0 : 5.0;
            EXPECT_LE(kinetic_energy(sheets.world, sheets.world.cloths[index]),
                      kinetic_energy(before, before.cloths[index]) * (1.0 + 1.0 / (cells * cells)));
        });
        sheets.coarsen_all();

        for (std::size_t c = 0; c < start.cloths.size(); ++c) {
            EXPECT_LE(kinetic_energy(sheets.world, sheets.world.cloths[c]),
                      kinetic_energy(start, start.cloths[c]) * (1.0 + 1e-4));
        }
    }
}

/// A spinning sheet of n x n cells that is refined all over loses 1/n^2 of its inertia, and its
/// corners go 1.7 times as fast as the mean: 5 % and 7 % here.
TEST(StateTransfer, ChangesNoVelocityByMuch) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        run_history(
            sheets, [&](const World& before, const std::vector<int>& old_names, std::size_t index) {
                const auto places = places_of(sheets.names());
                const Cloth& cloth = before.cloths[index];
                double greatest = 0.0;
                for (std::size_t i = at(cloth.first_vertex);
                     i < at(cloth.first_vertex + cloth.vertex_count); ++i) {
                    if (const auto place = places.find(old_names[i]); place != places.end()) {
                        const Vec3& now = sheets.world.velocities[place->second];
                        greatest = std::max(greatest, (now - before.velocities[i]).norm());
                    }
                }
                const double cells = index == 0 ? 6.0 : 5.0;
                // of a sheet that goes to pieces, what vertices taken out leave comes on top
                const double more = k_motions[seed % 3] == SheetMotion::Crumple ? 0.05 : 0.0;
                const double limit = 1.8 / (cells * cells) + more;
                EXPECT_LE(greatest, limit * test::rms_speed(before, cloth));
            });
    }
}

TEST(StateTransfer, VerticesThatStayAreNotMovedAndNewOnesStandAmongTheirParents) {
    for (unsigned seed = 0; seed < 9; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        std::size_t inserted = 0;
        run_history(sheets, [&](const World& before, const std::vector<int>& old_names,
                                std::size_t) {
            const World& now = sheets.world;
            const auto old_places = places_of(old_names);
            const std::vector<int> names = sheets.names();
            ASSERT_EQ(names.size(), now.vertex_count());
            for (std::size_t i = 0; i < names.size(); ++i) {
                const auto old = old_places.find(names[i]);
                if (old != old_places.end()) {
                    EXPECT_EQ(now.positions[i], before.positions[old->second]);
                    EXPECT_EQ(now.previous_positions[i], before.previous_positions[old->second]);
                } else {
                    ++inserted;
                    const AdaptingWorld::Place& place = sheets.place(names[i]);
                    EXPECT_LT((now.positions[i] - place.x).norm(), 1e-15);
                    EXPECT_LT((now.previous_positions[i] - place.previous).norm(), 1e-15);
                }
            }
        });
        EXPECT_GT(inserted, 100u);
    }
}

TEST(StateTransfer, RemembersWhereVerticesWereAtTheStart) {
    AdaptingWorld sheets(SheetMotion::Wave, 1);
    run_history(sheets, [&](auto&, auto&, std::size_t) {
        const std::vector<int> names = sheets.names();
        for (const Cloth& cloth : sheets.world.cloths) {
            for (std::size_t i = 0; i < cloth.refinement.start.size(); ++i) {
                const Vec3& start = sheets.place(names[at(cloth.first_vertex) + i]).start;
                EXPECT_LT((cloth.refinement.start[i] - start).norm(), 1e-15);
            }
        }
    });
}

TEST(StateTransfer, GivesBackMassesPinsAndVertexNumbersBitForBit) {
    for (unsigned seed = 0; seed < 9; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        const World start = sheets.world;
        const std::vector<int> names = sheets.names();

        run_history(sheets, [](auto&, auto&, std::size_t) {});
        ASSERT_NE(sheets.world.vertex_count(), start.vertex_count());
        sheets.coarsen_all();

        EXPECT_EQ(sheets.names(), names);
        EXPECT_EQ(sheets.world.masses, start.masses);
        EXPECT_EQ(sheets.world.positions, start.positions);
        EXPECT_EQ(sheets.world.previous_positions, start.previous_positions);
        ASSERT_EQ(sheets.world.pins.size(), start.pins.size());
        for (std::size_t i = 0; i < start.pins.size(); ++i) {
            EXPECT_EQ(sheets.world.pins[i].vertex, start.pins[i].vertex);
            EXPECT_EQ(sheets.world.pins[i].start, start.pins[i].start);
        }
        EXPECT_EQ(check(sheets.world), "");
    }
}

/// Of the changes of velocity in the last substep, of which BDF2 repeats a third.
PatchMomentum change_of(const World& world, const Cloth& cloth) {
    PatchMomentum sum;
    for (std::size_t i = at(cloth.first_vertex); i < at(cloth.first_vertex + cloth.vertex_count);
         ++i) {
        sum.add(world.masses[i], world.positions[i] - centre_of(cloth),
                world.velocities[i] - world.previous_velocities[i]);
    }
    return sum;
}

TEST(StateTransfer, TheHistoryOfTwoStepsKeepsItsMomentum) {
    for (unsigned seed = 0; seed < 9; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        run_history(sheets, [&](const World& before, auto&, std::size_t index) {
            const PatchMomentum old = change_of(before, before.cloths[index]);
            const PatchMomentum now = change_of(sheets.world, sheets.world.cloths[index]);
            const double scale = std::sqrt(2.0 * old.mass * old.kinetic);
            EXPECT_LE((now.linear - old.linear).norm(), 1e-12 * scale);
            EXPECT_LE((now.angular - old.angular).norm(), 1e-12 * scale);
        });
    }
}

TEST(StateTransfer, HoldsNewVerticesBetweenPinnedOnesAndNoOthers) {
    std::size_t most = 0;
    for (unsigned seed = 0; seed < 9; ++seed) {
        AdaptingWorld sheets(k_motions[seed % 3], seed);
        run_history(sheets, [&](auto&, auto&, std::size_t) {
            const World& world = sheets.world;
            const std::vector<int> names = sheets.names();
            std::vector<Index> wanted;
            for (Index v = world.cloths[2].first_vertex;
                 v < world.cloths[2].first_vertex + world.cloths[2].vertex_count; ++v) {
                if (sheets.place(names[at(v)]).start.z() < -1.2 + 1e-9) {
                    wanted.push_back(v);
                }
            }
            std::vector<Index> pinned;
            for (const Pin& pin : world.pins) {
                pinned.push_back(pin.vertex);
                EXPECT_LT((pin.start - sheets.place(names[at(pin.vertex)]).start).norm(), 1e-15);
                EXPECT_EQ(pin.group, 0);
            }
            EXPECT_EQ(pinned, wanted);
            most = std::max(most, pinned.size());
        });
    }
    EXPECT_GT(most, 8u); // six are imported
}

TEST(StateTransfer, ANewPinFollowsTheObstacleThatHoldsItsParents) {
    World world = AdaptingWorld(SheetMotion::Spin, 1).world;
    Obstacle& body = world.obstacles.emplace_back();
    body.mesh.positions = {{0.0, 0.0, -2.0}, {2.0, 0.0, -2.0}, {0.0, 0.0, 0.0}};
    body.mesh.triangles = {{0, 2, 1}};
    body.params.motion = {{0.0, Vec3::Zero(), Vec3::Zero()},
                          {1.0, {0.1, 0.2, 0.3}, {0.0, 90.0, 0.0}}};
    for (Pin& pin : world.pins) {
        pin.anchor = anchor_to(body, 0, pin.start);
    }
    const Cloth& cloth = world.cloths[2];
    const Pin& first = world.pins[0];
    const Pin& second = world.pins[1];
    StateTransfer transfer(world, cloth);

    transfer.insert(
        {cloth.vertex_count,
         {first.vertex - cloth.first_vertex, second.vertex - cloth.first_vertex, k_no_index},
         {2.0 / 3.0, 1.0 / 3.0, 0.0}});
    ++world.cloths[2].vertex_count;
    world.cloths[2].rest_areas.push_back(0.0);
    transfer.finish(world, 2, {.vertices = {{cloth.vertex_count - 1, k_no_index}}});

    const PinGroup& group = world.pin_groups[0];
    const auto held_at = [&](const Pin& pin) {
        return pin_position(pin, group, world.obstacles, 0.5);
    };
    const Pin& inserted = world.pins.back();
    EXPECT_EQ(inserted.vertex, cloth.first_vertex + cloth.vertex_count - 1);
    EXPECT_LT(
        (held_at(inserted) - (2.0 * held_at(world.pins[0]) + held_at(world.pins[1])) / 3.0).norm(),
        1e-12);
}

} // namespace
} // namespace weft
