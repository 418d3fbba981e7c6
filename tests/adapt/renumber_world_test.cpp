#include "adapt/change_log.h"
#include "support/adapting_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace weft {
namespace {

using test::AdaptingWorld;
using test::SheetMotion;

/// A vertex as the world names it, by its own name; those of obstacles, which stand behind all
/// others, by their number there.
int name_of(const World& world, const std::vector<int>& names, Index v) {
    const auto i = at(v);
    return v == k_no_index            ? -1
           : i < world.vertex_count() ? names[i]
                                      : 1000000 + v - static_cast<Index>(world.vertex_count());
}

using NamedPair = std::array<int, 4>;

std::map<NamedPair, double> named_memory(const World& world, const std::vector<int>& names) {
    std::map<NamedPair, double> memory;
    for (const FrictionHistory& one : world.friction_history) {
        if (is_transfer(one)) {
            continue;
        }
        NamedPair pair;
        std::transform(one.pair.begin(), one.pair.end(), pair.begin(),
                       [&](Index v) { return name_of(world, names, v); });
        memory[pair] = one.rest_gap;
    }
    return memory;
}

std::vector<std::array<int, 6>> named_pairs(const World& world, const std::vector<int>& names) {
    std::vector<std::array<int, 6>> pairs;
    for (const AttachedPair& pair : world.attached_pairs) {
        std::transform(pair.vertices.begin(), pair.vertices.end(), pairs.emplace_back().begin(),
                       [&](Index v) { return name_of(world, names, v); });
    }
    return pairs;
}

/// Names of the corners of the triangles that changed.
std::set<int>
corners_of(const AdaptingWorld& sheets, std::size_t index, const ClothChanges& changes) {
    const std::vector<int> names = sheets.names();
    const Cloth& cloth = sheets.world.cloths[index];
    std::set<int> corners;
    for (const Index t : changes.triangles) {
        for (const Index v : cloth.triangles[at(t)]) {
            corners.insert(names[at(cloth.first_vertex + v)]);
        }
    }
    return corners;
}

/// Adapts first and last cloth in turn; looks at each with the world and the names before, and the
/// names of corners of triangles that changed.
template <typename Look> void adapt_in_turn(unsigned seeds, const Look& look) {
    for (unsigned seed = 0; seed < seeds; ++seed) {
        AdaptingWorld sheets(SheetMotion::Wave, seed);
        for (int i = 0; i < 12; ++i) {
            const World before = sheets.world;
            const std::vector<int> names = sheets.names();
            const std::size_t index = i % 2 == 0 ? 0 : 2;
            const ClothChanges changes = sheets.adapt(index, 30, i < 6 ? 0.8 : 0.3);
            look(sheets, before, names, corners_of(sheets, index, changes));
        }
    }
}

TEST(RenumberWorld, AttachedPairsNameTheSamePoints) {
    adapt_in_turn(
        5, [](const AdaptingWorld& sheets, const World& before, const auto& names, const auto&) {
            EXPECT_EQ(named_pairs(sheets.world, sheets.names()), named_pairs(before, names));
        });
}

/// Of vertices whose triangles change, pairs end: see FrictionTransfer.
TEST(RenumberWorld, ContactRemembersTheSamePointsAndForgetsWhatIsGoneOrChanged) {
    std::size_t forgotten = 0;
    adapt_in_turn(10, [&](AdaptingWorld& sheets, const World& before, const auto& old_names,
                          const std::set<int>& changed) {
        const std::vector<int> names = sheets.names();
        auto kept = named_memory(before, old_names);
        forgotten += std::erase_if(kept, [&](const auto& one) {
            return std::any_of(one.first.begin(), one.first.end(), [&](int name) {
                return changed.count(name) != 0 ||
                       (name < 1000000 &&
                        std::find(names.begin(), names.end(), name) == names.end());
            });
        });

        EXPECT_EQ(named_memory(sheets.world, names), kept);
        const auto& memory = sheets.world.friction_history;
        EXPECT_TRUE(std::is_sorted(memory.begin(), memory.end(),
                                   [](const auto& a, const auto& b) { return a.pair < b.pair; }));
        // what is put in now is remembered from now on
        const auto last = static_cast<Index>(sheets.world.vertex_count()) - 1;
        const FrictionHistory newest{{last, last + 1, last + 2, last + 3}, 1.0, Vec3::Zero(), 0};
        if (memory.empty() || memory.back().pair < newest.pair) {
            sheets.world.friction_history.push_back(newest);
        }
    });
    EXPECT_GT(forgotten, 0u);
}

TEST(RenumberWorld, ClothsStandOneBehindTheOther) {
    adapt_in_turn(3, [](const AdaptingWorld& sheets, const World&, const auto&, const auto&) {
        const World& world = sheets.world;
        Index next = 0;
        for (const Cloth& cloth : world.cloths) {
            EXPECT_EQ(cloth.first_vertex, next);
            next += cloth.vertex_count;
        }
        EXPECT_EQ(at(next), world.vertex_count());
        EXPECT_EQ(check(world), "");
    });
}

TEST(RenumberWorld, VerticesOfOtherClothsKeepTheirValues) {
    adapt_in_turn(
        3, [](const AdaptingWorld& sheets, const World& before, const auto&, const auto&) {
            const Cloth& old_plain = before.cloths[1];
            const Cloth& plain = sheets.world.cloths[1];
            for (Index v = 0; v < plain.vertex_count; ++v) {
                const auto i = at(plain.first_vertex + v);
                const auto old = at(old_plain.first_vertex + v);
                EXPECT_EQ(sheets.world.positions[i], before.positions[old]);
                EXPECT_EQ(sheets.world.velocities[i], before.velocities[old]);
                EXPECT_EQ(sheets.world.previous_positions[i], before.previous_positions[old]);
                EXPECT_EQ(sheets.world.previous_velocities[i], before.previous_velocities[old]);
                EXPECT_EQ(sheets.world.masses[i], before.masses[old]);
            }
        });
}

} // namespace
} // namespace weft
