#include "base/parallel.h"
#include "collide/crossings.h"
#include "collide/untangle.h"
#include "support/contact_world.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

std::size_t crossings_of(const World& world) {
    return find_crossings(world, 1000000).size();
}

/// A sheet whose middle is `depth` below the top of a ball of radius 0.2 m.
World sheet_in_ball(double depth) {
    World world;
    test::add_sheet(world, 20, 0.6, 0.2 - depth, {});
    test::add_sphere(world, 0.2, Vec3::Zero());
    return world;
}

/// Mean of a cloth's heights, m.
double mean_height(const World& world, const Cloth& cloth) {
    double sum = 0.0;
    for (const Vec3& x : world.positions_of(cloth)) {
        sum += x.y();
    }
    return sum / cloth.vertex_count;
}

/// Two sheets of which the second one stands across the first in waves.
World woven_sheets(int layer_of_second) {
    World world;
    test::add_sheet(world, 20, 0.5, 0.0, {});
    Cloth& second = test::add_sheet(world, 17, 0.4, 0.0, {});
    second.params.layer = layer_of_second;
    for (Index i = 0; i < second.vertex_count; ++i) {
        Vec3& x = world.positions[static_cast<std::size_t>(second.first_vertex + i)];
        x.y() = 0.004 + 0.012 * std::sin(20.0 * x.x());
    }
    return world;
}

} // namespace

TEST(Untangle, TakesASheetOutOfABallToItsOuterSide) {
    World world = sheet_in_ball(0.02);
    const std::size_t before = crossings_of(world);

    const UntangleReport report = untangle(world);

    EXPECT_GT(before, 50U);
    EXPECT_EQ(report.pairs_before, before);
    EXPECT_EQ(report.pairs_after, 0U);
    EXPECT_EQ(crossings_of(world), 0U);
    for (const Vec3& x : world.positions) {
        EXPECT_GT(x.norm(), 0.2 * 0.995); // the ball is a polyhedron within its sphere
    }
    // the middle of the sheet had 20 mm to go and half a thickness of room is wanted
    EXPECT_NEAR(report.max_displacement, 0.0205, 0.003);
}

TEST(Untangle, LeavesRoom) {
    World world = sheet_in_ball(0.01);
    untangle(world);
    ContactSolver solver(world, {});

    const ContactReport report = test::contact_step(world, solver, 1e-4);

    EXPECT_EQ(report.unresolved, 0);
    EXPECT_GT(report.min_gap, 0.4e-3); // half of the thickness of 1 mm, less a little
}

TEST(Untangle, LeavesClothThatDoesNotCrossWhereItIs) {
    World world = sheet_in_ball(-0.01);
    const std::vector<Vec3> before = world.positions;

    const UntangleReport report = untangle(world);

    EXPECT_EQ(world.positions, before);
    EXPECT_EQ(report.rounds, 0);
    EXPECT_EQ(report.max_displacement, 0.0);
}

TEST(Untangle, HardlyDistortsTriangles) {
    World world = sheet_in_ball(0.02);
    untangle(world);

    for (const MeshEdge& edge : world.cloths[0].topology.edges) {
        const auto& u = world.cloths[0].material_positions;
        const auto a = static_cast<std::size_t>(edge.v[0]);
        const auto b = static_cast<std::size_t>(edge.v[1]);
        const double stretch =
            (world.positions[a] - world.positions[b]).norm() / (u[a] - u[b]).norm();
        // a cap of 20 mm on a chord of 87 mm is longer by 2/3 (20/87)^2 = 3.5 %
        EXPECT_NEAR(stretch, 1.0, 0.12);
    }
}

TEST(Untangle, PutsTheHigherLayerOutside) {
    for (const int layer : {1, -1}) {
        World world = woven_sheets(layer);
        test::add_floor(world, 3.0, -0.5); // says where outside is: away from it
        ASSERT_GT(crossings_of(world), 50U);

        const UntangleReport report = untangle(world);

        EXPECT_EQ(report.pairs_after, 0U) << layer;
        EXPECT_EQ(crossings_of(world), 0U);
        const double above =
            mean_height(world, world.cloths[1]) - mean_height(world, world.cloths[0]);
        EXPECT_GT(layer * above, 0.0);
    }
}

TEST(Untangle, MovesOnlyTheHigherOfTwoLayers) {
    World world = woven_sheets(2);
    const std::vector<Vec3> before = world.positions;

    untangle(world);

    const auto count = static_cast<std::ptrdiff_t>(world.cloths[0].vertex_count);
    EXPECT_TRUE(std::equal(before.begin(), before.begin() + count, world.positions.begin()));
}

TEST(Untangle, PartsSheetsOfOneLayerToTheSideWhereMoreOfTheLaterOneIs) {
    World world = woven_sheets(0); // the second one is 4 mm above the first on average

    const UntangleReport report = untangle(world);

    EXPECT_EQ(report.pairs_after, 0U);
    EXPECT_EQ(crossings_of(world), 0U);
    EXPECT_GT(mean_height(world, world.cloths[1]), mean_height(world, world.cloths[0]));
}

TEST(Untangle, PartsTwoSheetsWhoseEdgesCross) {
    World world;
    test::add_sheet(world, 12, 0.4, 0.0, {});
    const Cloth& second = test::add_sheet(world, 12, 0.4, 0.0, {});
    for (Index i = 0; i < second.vertex_count; ++i) {
        Vec3& x = world.positions[static_cast<std::size_t>(second.first_vertex + i)];
        x = {0.36 + x.x(), -0.5 * x.x() - 0.08, x.z()}; // its rim dips through that of the first
    }
    ASSERT_GT(crossings_of(world), 10U);

    EXPECT_EQ(untangle(world).pairs_after, 0U);
    EXPECT_EQ(crossings_of(world), 0U);
}

TEST(Untangle, PartsAFoldThatCrossesItself) {
    World world;
    const Cloth& sheet = test::add_sheet(world, 24, 0.6, 0.0, {});
    for (Index i = 0; i < sheet.vertex_count; ++i) {
        // a sheet bent over to a flat U whose ends cross
        Vec3& x = world.positions[static_cast<std::size_t>(i)];
        const double s = x.x() / 0.3;
        x.x() = 0.3 * (1.0 - s * s);
        x.y() = 0.05 * (s > 0 ? 1.0 : -1.0) * std::abs(s) * (0.9 - std::abs(s)) * 4.0;
    }
    ASSERT_GT(crossings_of(world), 20U);

    const UntangleReport report = untangle(world);

    EXPECT_EQ(report.pairs_after, 0U);
    EXPECT_EQ(crossings_of(world), 0U);
}

TEST(Untangle, GivesTheSameBitsForAnyNumberOfThreads) {
    World one = sheet_in_ball(0.02);
    World many = sheet_in_ball(0.02);

    set_thread_count(1);
    untangle(one);
    set_thread_count(4);
    untangle(many);
    set_thread_count(0);

    EXPECT_EQ(one.positions, many.positions);
}

TEST(Untangle, LeavesWhatItIsNotAskedToPart) {
    World world = sheet_in_ball(0.02);
    const std::vector<Vec3> before = world.positions;

    const UntangleReport report = untangle(world, {.obstacles = false});

    EXPECT_EQ(world.positions, before);
    EXPECT_EQ(report.pairs_before, 0U);
}

} // namespace weft
