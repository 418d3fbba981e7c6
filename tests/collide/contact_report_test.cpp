#include "collide/contact_report.h"
#include "collide/impact_zones.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

#include <set>

namespace weft {

namespace {

constexpr double k_dt = 1e-3;

constexpr ObjectId k_sheet{ObjectKind::Cloth, 0};
constexpr ObjectId k_below{ObjectKind::Obstacle, 0}, k_above{ObjectKind::Obstacle, 1};
using Objects = std::array<ObjectId, 2>;

/// A sheet 0.4 mm over one box and, if wanted, as much under another.
struct Pressed {
    World world;
    ContactSurface surface;
    std::vector<Candidate> candidates;
    std::vector<Impact> all; ///< every pair of sheet and box that is 0.4 mm apart

    explicit Pressed(bool from_above) {
        test::add_sheet(world, 6, 0.3, 0.0, {});
        test::add_box(world, Vec3(0.4, 0.1, 0.4), Vec3(0.0, -0.0504, 0.0));
        if (from_above) {
            test::add_box(world, Vec3(0.4, 0.1, 0.4), Vec3(0.0, 0.0504, 0.0));
        }
        const std::vector<Vec3> still(world.vertex_count(), Vec3::Zero());
        surface = make_surface(world);
        place_surface(surface, world, still, std::vector<char>(still.size(), 0), k_dt);
        BroadPhase(surface, true).find(surface, k_dt, candidates);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const auto& v = candidates[i].vertices;
            PairPoints x;
            for (std::size_t k = 0; k < 4; ++k) {
                x[k] = surface.start[static_cast<std::size_t>(v[k])];
            }
            if (surface.is_deformable(v[0]) != surface.is_deformable(v[3]) &&
                separation(candidates[i].kind, x).distance < 0.00041) {
                all.push_back({static_cast<Index>(i), 0.0});
            }
        }
    }

    std::vector<UnresolvedPair> describe() const {
        return describe_unresolved(surface, candidates, all, surface.start);
    }
};

UnresolvedPair pair_of(Index a, Index b, PairFault fault = PairFault::Crossing) {
    return {.triangles = {a, b}, .fault = fault};
}

} // namespace

TEST(UnresolvedPairs, AreTooNearToWhatPushesFromOneSide) {
    const Pressed pressed(false);

    const std::vector<UnresolvedPair> pairs = pressed.describe();

    ASSERT_GT(pairs.size(), 10U);
    for (const UnresolvedPair& pair : pairs) {
        EXPECT_EQ(pair.fault, PairFault::TooNear);
        EXPECT_EQ(pair.objects, (Objects{k_sheet, k_below}));
        EXPECT_LT(pair.triangles[0], 2 * 6 * 6);
        EXPECT_LT(pair.triangles[1], 12);
        EXPECT_NEAR(pair.place.y(), -0.0002, 0.00021); // on sheet or box
    }
}

TEST(UnresolvedPairs, ArePinchedWhereTwoObstaclesPushAgainstEachOther) {
    const Pressed pressed(true);

    const std::vector<UnresolvedPair> pairs = pressed.describe();

    std::set<Objects> objects;
    for (const UnresolvedPair& pair : pairs) {
        EXPECT_EQ(pair.fault, PairFault::Pinched);
        objects.insert(pair.objects);
    }
    EXPECT_EQ(objects, (std::set<Objects>{{k_sheet, k_below}, {k_sheet, k_above}}));
}

TEST(UnresolvedPairs, OfTwoTrianglesAreToldOnce) {
    const Pressed pressed(true);

    const std::vector<UnresolvedPair> pairs = pressed.describe();

    ASSERT_LT(pairs.size(), pressed.all.size());
    std::set<std::pair<Objects, std::array<Index, 2>>> seen;
    for (const UnresolvedPair& pair : pairs) {
        EXPECT_TRUE(seen.insert({pair.objects, pair.triangles}).second);
    }
}

TEST(UnresolvedPairs, OfNoneAreNone) {
    const Pressed pressed(true);

    EXPECT_TRUE(describe_unresolved(pressed.surface, pressed.candidates, {}, pressed.surface.start)
                    .empty());
}

TEST(UnresolvedPairs, OfOnePairTheLastIsKept) {
    std::vector<UnresolvedPair> pairs;
    const std::vector<UnresolvedPair> first{pair_of(5, 9), pair_of(1, 2)};
    const std::vector<UnresolvedPair> second{pair_of(5, 9), pair_of(5, 9, PairFault::Pinched)};
    add_unresolved(pairs, 0.1, first);
    add_unresolved(pairs, 0.2, second);

    keep_last_of_each(pairs);

    ASSERT_EQ(pairs.size(), 3U);
    EXPECT_EQ(pairs[0].triangles, (std::array<Index, 2>{1, 2}));
    EXPECT_EQ(pairs[0].time, 0.1);
    EXPECT_EQ(pairs[1].triangles, (std::array<Index, 2>{5, 9}));
    EXPECT_EQ(pairs[1].fault, PairFault::Crossing);
    EXPECT_EQ(pairs[1].time, 0.2);
    EXPECT_EQ(pairs[2].fault, PairFault::Pinched);
}

} // namespace weft
