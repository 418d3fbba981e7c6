#include "collide/left_pairs.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

#include <set>

namespace weft {

namespace {

constexpr double k_dt = 1e-3;

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

    std::vector<ContactProblem> describe() const {
        return describe_left(surface, candidates, all, surface.start);
    }
};

} // namespace

TEST(LeftPairs, AreTooNearToWhatPushesFromOneSide) {
    const Pressed pressed(false);

    const std::vector<ContactProblem> problems = pressed.describe();

    ASSERT_GT(problems.size(), 10U);
    for (const ContactProblem& problem : problems) {
        EXPECT_EQ(problem.kind, ProblemKind::TooNear);
        EXPECT_EQ(problem.objects, (std::array<Index, 2>{0, 1}));
        EXPECT_LT(problem.triangles[0], 2 * 6 * 6);
        EXPECT_LT(problem.triangles[1], 12);
        EXPECT_NEAR(problem.place.y(), -0.0002, 0.00021); // on sheet or box
    }
}

TEST(LeftPairs, ArePinchedWhereTwoObstaclesPushAgainstEachOther) {
    const Pressed pressed(true);

    const std::vector<ContactProblem> problems = pressed.describe();

    std::set<std::array<Index, 2>> objects;
    for (const ContactProblem& problem : problems) {
        EXPECT_EQ(problem.kind, ProblemKind::Pinched);
        objects.insert(problem.objects);
    }
    EXPECT_EQ(objects, (std::set<std::array<Index, 2>>{{0, 1}, {0, 2}}));
}

TEST(LeftPairs, OfTwoTrianglesAreToldOnce) {
    const Pressed pressed(true);

    const std::vector<ContactProblem> problems = pressed.describe();

    ASSERT_LT(problems.size(), pressed.all.size());
    std::set<std::pair<std::array<Index, 2>, std::array<Index, 2>>> seen;
    for (const ContactProblem& problem : problems) {
        EXPECT_TRUE(seen.insert({problem.objects, problem.triangles}).second);
    }
}

TEST(LeftPairs, OfNoneAreNone) {
    const Pressed pressed(true);

    EXPECT_TRUE(
        describe_left(pressed.surface, pressed.candidates, {}, pressed.surface.start).empty());
}

} // namespace weft
