#include "adapt/friction_transfer.h"
#include "support/adapting_world.h"
#include "support/objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace weft {
namespace {

using test::AdaptingWorld;
using test::SheetMotion;

/// Two sheets of 16 vertices over a floor of 4.
World sheets_over_floor() {
    World world;
    test::add_sheet(world, 3, 0.3, 0.002, {});
    test::add_sheet(world, 3, 0.3, 0.001, {});
    test::add_floor(world, 1.0, 0.0);
    return world;
}

/// Slip of each vertex of the cloth at `first` against each object, named by its first vertex, by
/// looking at every pair; those within the cloth count with both ends.
std::map<std::array<Index, 2>, Vec3> slow_transfer(std::span<const FrictionHistory> memory,
                                                   Index first,
                                                   std::span<const char> is_changed) {
    constexpr std::array<Index, 3> k_objects{0, 16, 32};
    const auto is_own = [&](Index v) { return v >= first && v < first + 16; };
    std::map<std::array<Index, 2>, Vec3> transfers;
    const auto add = [&](Index v, Index partner, const Vec3& slip) {
        const Index object = k_objects[at(std::min(partner / 16, Index{2}))];
        transfers.try_emplace({v, object}, Vec3::Zero()).first->second += slip;
    };
    for (const FrictionHistory& one : memory) {
        std::vector<Index> own;
        std::copy_if(one.pair.begin(), one.pair.end(), std::back_inserter(own), is_own);
        if (std::none_of(own.begin(), own.end(),
                         [&](Index v) { return is_changed[at(v - first)] != 0; })) {
            continue;
        }
        if (own.size() == 4) {
            add(own[0], own[0], 0.5 * one.slip);
            add(own[3], own[3], -0.5 * one.slip);
            continue;
        }
        const bool is_first_side = own[0] == one.pair[0];
        for (const Index v : own) {
            add(v, is_first_side ? one.pair[3] : one.pair[0],
                (is_first_side ? 1.0 : -1.0) / double(own.size()) * one.slip);
        }
    }
    return transfers;
}

/// Vertices against faces and edges against edges, of the first sheet with all there is.
std::vector<FrictionHistory> all_kinds_of_pairs() {
    std::vector<FrictionHistory> memory;
    const auto add = [&](std::array<Index, 4> pair) {
        const double k = static_cast<double>(memory.size() + 1);
        memory.push_back({pair, 1e-4 * k, {1e-5 * k, -2e-5, 3e-6 * k * k}, 0});
    };
    add({0, 5, 6, 9});    // within it
    add({0, 16, 17, 20}); // vertex, face of the second
    add({0, 17, 18, 21});
    add({1, 2, 20, 21});  // edge, edge of the second
    add({1, 32, 33, 34}); // vertex, floor
    add({4, 5, 33, 34});  // edge, edge of the floor
    add({12, 32, 33, 34});
    add({17, 1, 2, 5}); // vertex of the second, face
    add({22, 9, 10, 13});
    add({34, 2, 3, 6}); // corner of the floor, face
    add({20, 32, 33, 34});
    return memory;
}

TEST(FrictionTransfer, AreTheSlipsOfPairsThatEndAsTheirVerticesSeeThem) {
    World world = sheets_over_floor();
    world.friction_history = all_kinds_of_pairs();
    std::vector<char> is_changed(16, 0);
    for (const int v : {0, 1, 4, 6, 13}) {
        is_changed[at(v)] = 1;
    }
    const auto expected = slow_transfer(world.friction_history, 0, is_changed);
    std::vector<Index> former(16);
    std::iota(former.begin(), former.end(), 0);
    const std::span masses(world.masses.data(), 16); // and they stay

    const FrictionTransfer transfers(world, 0, is_changed);
    const std::vector<FrictionHistory> kept = world.friction_history;
    transfers.leave(world, former, masses);

    std::size_t count = 0;
    for (const FrictionHistory& one : world.friction_history) {
        if (is_transfer(one)) {
            const Vec3& slip = expected.at({one.pair[0], one.pair[3]});
            EXPECT_LT((one.slip - slip).norm(), 1e-15);
            ++count;
        }
    }
    EXPECT_EQ(count, expected.size());
    ASSERT_EQ(kept.size(), 2u); // 12 on the floor, the second sheet on it
    EXPECT_EQ(kept[0].pair[0], 12);
    EXPECT_EQ(kept[1].pair[0], 20);
}

TEST(FrictionTransfer, TakeTheGreatestRestGapAndWhetherAnythingSlides) {
    World world = sheets_over_floor();
    world.friction_history = {{{0, 32, 33, 34}, 2e-4, Vec3::Zero(), 0},
                              {{0, 33, 34, 35}, 5e-4, Vec3::Zero(), 1}};
    const std::vector<char> is_changed(16, 1);
    std::vector<Index> former(16);
    std::iota(former.begin(), former.end(), 0);

    FrictionTransfer(world, 0, is_changed).leave(world, former, std::span(world.masses).first(16));

    ASSERT_EQ(world.friction_history.size(), 1u);
    EXPECT_EQ(world.friction_history[0].pair, transfer_key(0, 32));
    EXPECT_EQ(world.friction_history[0].rest_gap, 5e-4);
    EXPECT_EQ(world.friction_history[0].slides, 1);
}

/// Traction that is linear over the rest shape stays the same function of it, whatever vertices
/// come and go, as parents' means are exact for it; a force is that times the mass.
TEST(FrictionTransfer, LinearTractionStaysTheSameOverAnyHistory) {
    const auto traction = [](const Vec2& u) {
        return Vec3(1e-3 + 2e-3 * u.x(), -5e-4 * u.y(), 3e-3 * (u.x() - u.y()));
    };
    for (unsigned seed = 0; seed < 6; ++seed) {
        AdaptingWorld sheets(SheetMotion::Wave, seed);
        World& world = sheets.world;
        const auto obstacle = [&] { return static_cast<Index>(world.vertex_count()); };
        world.obstacles.emplace_back().mesh.positions.resize(3);
        const auto remember_all = [&] { // as a substep does
            world.friction_history.clear();
            const Cloth& cloth = world.cloths[0];
            for (Index v = 0; v < cloth.vertex_count; ++v) {
                const Index o = obstacle();
                world.friction_history.push_back(
                    {{v, o, o + 1, o + 2},
                     1e-3,
                     world.masses[at(v)] * traction(cloth.material_positions[at(v)]),
                     0});
            }
        };
        remember_all();
        for (int i = 0; i < 8; ++i) {
            sheets.adapt(0, 30, i < 5 ? 0.8 : 0.3);

            const Cloth& cloth = world.cloths[0];
            ASSERT_EQ(world.friction_history.size(), at(cloth.vertex_count));
            for (Index v = 0; v < cloth.vertex_count; ++v) {
                const FrictionHistory& one = world.friction_history[at(v)];
                EXPECT_EQ(one.pair[0], v);
                EXPECT_EQ(one.pair[3], obstacle() + (is_transfer(one) ? 0 : 2));
                EXPECT_NEAR(one.rest_gap, 1e-3, 1e-18);
                const Vec3 expected =
                    world.masses[at(v)] * traction(cloth.material_positions[at(v)]);
                EXPECT_LT((one.slip - expected).norm(), 1e-18) << v; // of 1e-6
            }
            if (i % 3 != 0) { // transfers are left over to the next adaptation, too
                remember_all();
            }
        }
    }
}

TEST(FrictionTransfer, WhatTouchesNothingLeavesNothing) {
    AdaptingWorld sheets(SheetMotion::Wave, 3);
    sheets.world.friction_history.clear();

    sheets.adapt(0, 30, 0.8);

    EXPECT_TRUE(sheets.world.friction_history.empty());
}

} // namespace
} // namespace weft
