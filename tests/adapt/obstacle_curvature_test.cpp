#include "adapt/adaptation_plan.h"
#include "state/obstacle.h"
#include "support/objects.h"

#include <gtest/gtest.h>

#include <numbers>

namespace weft {
namespace {

/// Sheets of 0.2 m cells: a vertex of theirs reaches sqrt(0.2^2 / 2) m.
constexpr double k_reach = 0.1414;

struct Scenery {
    World world;
    std::vector<double> found;

    /// A sheet 1 m wide at a height over a sphere of radius 2 m about the origin.
    explicit Scenery(double height, double scale = 1.0) {
        test::add_sheet(world, 5, 1.0, height, {});
        test::add_sphere(world, 2.0 * scale, Vec3::Zero(), 4);
    }
    void find(double time = 0.0) {
        ObstacleCurvature(world).find(world, world.cloths[0], time, found);
    }
    double distance(std::size_t vertex, double radius = 2.0) const {
        return world.positions[vertex].norm() - radius;
    }
};

/// What is as near as the facets' own sagging is left out.
void expect_curvature_within(const Scenery& scenery, double radius, double reach) {
    int near = 0, far = 0;
    for (std::size_t i = 0; i < scenery.found.size(); ++i) {
        const double distance = scenery.distance(i, radius);
        if (distance < reach - 0.01) {
            EXPECT_NEAR(scenery.found[i], 1.0 / radius, 0.03 / radius);
            ++near;
        } else if (distance > reach + 0.01) {
            EXPECT_EQ(scenery.found[i], 0.0);
            ++far;
        }
    }
    EXPECT_GT(near, 0);
    EXPECT_GT(far, 0);
}

TEST(ObstacleCurvature, OfASphereIsOneOverItsRadiusWithinTheReach) {
    Scenery scenery(2.06);

    scenery.find();

    expect_curvature_within(scenery, 2.0, k_reach);
}

TEST(ObstacleCurvature, IsSeenFurtherAheadByWhatMovesFaster) {
    Scenery scenery(2.2);
    scenery.find();
    for (const double curvature : scenery.found) {
        EXPECT_EQ(curvature, 0.0);
    }
    std::fill(scenery.world.velocities.begin(), scenery.world.velocities.end(),
              Vec3(0.0, -3.0, 0.0));

    scenery.find();

    expect_curvature_within(scenery, 2.0, k_reach + 3.0 * ObstacleCurvature::k_look_ahead);
}

TEST(ObstacleCurvature, GoesWithAnObstacleThatMoves) {
    Scenery scenery(2.06);
    Obstacle& sphere = scenery.world.obstacles[0];
    sphere.params.motion = {{0.0, Vec3::Zero(), Vec3::Zero()},
                            {1.0, Vec3(0.0, -0.5, 0.0), Vec3(0.0, 90.0, 0.0)}};

    scenery.find(1.0);

    for (const double curvature : scenery.found) {
        EXPECT_EQ(curvature, 0.0);
    }
}

TEST(ObstacleCurvature, GoesWithAnObstacleThatDeforms) {
    Scenery scenery(2.06);
    Obstacle& sphere = scenery.world.obstacles[0];
    const std::vector<Vec3> places = sphere.mesh.positions;
    const auto grow = [places](double t, std::span<Vec3> x) {
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] = (1.0 - 0.5 * t) * places[i]; // half as large after a second
        }
    };
    sphere.deformation = std::make_shared<Deformation>(places.size(), 1, grow);
    ObstacleCurvature curvature(scenery.world);

    curvature.find(scenery.world, scenery.world.cloths[0], 1.0, scenery.found);
    for (const double found : scenery.found) {
        EXPECT_EQ(found, 0.0); // it has gone away
    }
    curvature.find(scenery.world, scenery.world.cloths[0], 0.0, scenery.found);
    expect_curvature_within(scenery, 2.0, k_reach);
}

TEST(ObstacleCurvature, OfARidgeIsItsAngleWithinOneTriangleAndNothingBeside) {
    World world;
    test::add_sheet(world, 5, 1.0, 0.02, {});
    test::add_box(world, Vec3(2.0, 1.0, 4.0), Vec3(-0.9, -0.5, 0.0)); // ends at x = 0.1
    std::vector<double> found;

    ObstacleCurvature(world).find(world, world.cloths[0], 0.0, found);

    int over_ridge = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const bool is_over = std::abs(world.positions[i].x() - 0.1) < 0.01;
        const double quarter_turn = 0.5 * std::numbers::pi / (2.0 * k_reach);
        EXPECT_NEAR(found[i], is_over ? quarter_turn : 0.0, 0.01);
        over_ridge += is_over ? 1 : 0;
    }
    EXPECT_EQ(over_ridge, 6);
}

TEST(ObstacleCurvature, OfSeveralObstaclesIsTheGreatest) {
    Scenery scenery(2.06);
    test::add_floor(scenery.world, 4.0, 2.0);
    test::add_sphere(scenery.world, 0.5, Vec3(0.0, 2.6, 0.0), 3);

    scenery.find();

    for (std::size_t i = 0; i < scenery.found.size(); ++i) {
        const double distance = (scenery.world.positions[i] - Vec3(0.0, 2.6, 0.0)).norm() - 0.5;
        if (distance < k_reach - 0.01) {
            EXPECT_NEAR(scenery.found[i], 2.0, 0.1);
        } else if (distance > k_reach + 0.01) {
            EXPECT_LT(scenery.found[i], 0.6);
        }
    }
}

} // namespace
} // namespace weft
