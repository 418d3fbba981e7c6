#include "base/parallel.h"
#include "frames/statistics.h"
#include "frames/statistics_columns.h"
#include "support/grid_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

TEST(Statistics, OfAFallingSheetAreThoseOfAPointMass) {
    World world = test::grid_world(1.0, 4);
    for (Vec3& x : world.positions) {
        x.y() += 2.0;
    }
    world.velocities.assign(world.vertex_count(), Vec3(0.0, -3.0, 0.0));
    const SceneParams scene; // gravity 9.81 m/s^2
    const double mass = world.cloths[0].params.fabric.area_density * 1.0;

    const MotionStatistics motion = StatisticsCollector(world, scene).measure(world, {}, 0).motion;

    EXPECT_NEAR(motion.kinetic, 0.5 * mass * 9.0, 1e-12);
    EXPECT_NEAR(motion.gravity, mass * 9.81 * 2.0, 1e-12);
    EXPECT_NEAR(motion.membrane, 0.0, 1e-12);
    EXPECT_NEAR(motion.bending, 0.0, 1e-12);
    EXPECT_LT((motion.centre_of_mass - Vec3(0.0, 2.0, 0.0)).norm(), 1e-12);
    EXPECT_EQ(motion.max_speed, 3.0);
}

TEST(Statistics, OfATautSheetHoldItsMembraneEnergy) {
    World world = test::grid_world(1.0, 4);
    for (Vec3& x : world.positions) {
        x *= 1.1;
    }
    const FabricParams& fabric = world.cloths[0].params.fabric;

    const FrameStatistics statistics = StatisticsCollector(world, {}).measure(world, {}, 0);

    // Equal stretch both ways on 1 m^2: W = E e^2 / (1 - nu), isotropic plane stress.
    const double expected = fabric.stretch_stiffness[0] * 0.01 / (1.0 - fabric.poisson);
    EXPECT_NEAR(statistics.motion.membrane, expected, 1e-9 * expected);
    EXPECT_NEAR(statistics.strain.stretch_min, 1.1, 1e-12);
    EXPECT_NEAR(statistics.strain.stretch_max, 1.1, 1e-12);
}

TEST(Statistics, WeighStretchByRestArea) {
    World world = test::grid_world(1.0, 10); // 200 triangles, 20 in each row along x
    // The last two of ten rows, 20 % of the area, are half again as long.
    for (Vec3& x : world.positions) {
        x.z() += 0.5 * std::max(0.0, x.z() - 0.3);
    }

    const StrainStatistics strain = measure_strain(world);

    EXPECT_NEAR(strain.stretch_mean, 0.8 * 1.0 + 0.2 * 1.5, 1e-9);
    EXPECT_NEAR(strain.stretch_p95, 1.5, 1e-9);
    EXPECT_NEAR(strain.stretch_min, 1.0, 1e-9);
}

TEST(Statistics, LeastAngleIsThatOfTheRestShape) {
    World world = test::grid_world(1.0, 4); // right isosceles triangles
    for (Vec3& x : world.positions) {
        x.x() += 0.5 * x.z();
    }

    const FrameStatistics statistics = StatisticsCollector(world, {}).measure(world, {}, 0);

    EXPECT_NEAR(statistics.least_angle_deg, 45.0, 1e-9);
}

TEST(Statistics, AreTheSameTextForAnyThreadCount) {
    World world = test::grid_world(1.0, 40);
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.positions[i].y() = 0.01 * std::sin(0.37 * static_cast<double>(i));
    }
    StatisticsCollector statistics_collector(world, {});

    set_thread_count(1);
    const std::string one = statistics_row(statistics_collector.measure(world, {}, 0));
    set_thread_count(2);
    const std::string two = statistics_row(statistics_collector.measure(world, {}, 0));
    set_thread_count(0);

    EXPECT_EQ(one, two);
}

} // namespace
} // namespace weft
