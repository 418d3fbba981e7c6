#include "forces/air.h"
#include "support/derivatives.h"
#include "support/sheets.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

using namespace test;

namespace {

/// A closed box of 12 triangles, normals outwards, corners displaced at random.
Cloth closed_box(std::vector<Vec3>& positions, double pressure) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-0.2, 0.2);
    for (int i = 0; i < 8; ++i) {
        positions.emplace_back((i & 1) + uniform(random), ((i >> 1) & 1) + uniform(random),
                               ((i >> 2) & 1) + uniform(random));
    }
    Cloth cloth;
    cloth.vertex_count = 8;
    cloth.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    cloth.params.pressure = pressure;
    return cloth;
}

std::vector<Vec3> gathered(const AirElements& air, std::span<const Vec3> x) {
    const std::vector<Vec3> v(x.size(), Vec3::Zero());
    std::vector<Vec3> f(3 * air.size()), sum(x.size(), Vec3::Zero());
    air.forces(x, v, f);
    for (std::size_t i = 0; i < f.size(); ++i) {
        sum[at(air.nodes()[i])] += f[i];
    }
    return sum;
}

} // namespace

TEST(Pressure, PushesAClosedClothNowhere) {
    std::vector<Vec3> x;
    const AirElements air(closed_box(x, 50.0), {.air_density = 0.0});

    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    const std::vector<Vec3> force = gathered(air, x);
    for (std::size_t i = 0; i < x.size(); ++i) {
        sum += force[i];
        torque += x[i].cross(force[i]);
    }

    EXPECT_LT(sum.norm(), 1e-13 * 50.0);
    EXPECT_LT(torque.norm(), 1e-13 * 50.0);
    EXPECT_GT(force[7].dot(Vec3(1, 1, 1)), 0.0); // outwards
}

TEST(Pressure, IsTheGradientOfPressureTimesVolume) {
    std::vector<Vec3> x;
    const AirElements air(closed_box(x, 50.0), {.air_density = 0.0});

    const std::vector<Vec3> force = gathered(air, x);

    for (std::size_t i = 0; i < x.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            auto above = x, below = x;
            above[i](axis) += 1e-5;
            below[i](axis) -= 1e-5;
            EXPECT_NEAR(force[i](axis), -(air.energy(above) - air.energy(below)) / 2e-5, 1e-7);
        }
    }
}

TEST(AirDrag, StopsAPlateAtItsTerminalSpeed) {
    // A horizontal plate of mass per area m falls steadily when rho/2 c v^2 = m g.
    const double mass_per_area = 0.15, density = 1.2;
    const double terminal = std::sqrt(2.0 * mass_per_area * 9.81 / (density * k_plate_drag));
    const Vec3 doubled_area_normal(0.0, 2.0, 0.0); // 1 m^2

    const AirForce air = air_drag(doubled_area_normal, Vec3(0.0, -terminal, 0.0), density);

    EXPECT_NEAR(air.force.y(), mass_per_area * 9.81, 1e-12);
    EXPECT_NEAR(air.force.x(), 0.0, 1e-15);
}

TEST(AirDrag, EdgeOnIsSkinFrictionAlone) {
    const AirForce air = air_drag(Vec3(0.0, 2.0, 0.0), Vec3(3.0, 0.0, 4.0), 1.2);

    EXPECT_LT((air.force + 0.5 * 1.2 * k_skin_friction * 5.0 * Vec3(3.0, 0.0, 4.0)).norm(), 1e-14);
}

TEST(AirDrag, TakesPowerInStillAirAndItsMatrixIsTheDerivative) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        const Vec3 n(normal(random), normal(random), normal(random));
        const Vec3 u(normal(random), normal(random), normal(random));
        const auto force = [&](const VecX& velocity) {
            return VecX(air_drag(n, Vec3(velocity), 1.2).force);
        };

        const AirForce air = air_drag(n, u, 1.2);

        EXPECT_LT(air.force.dot(u), 0.0);
        EXPECT_LT((air.damping + numerical_jacobian(force, u, 1e-6)).norm(),
                  1e-7 * (1.0 + air.damping.norm()));
        EXPECT_GE(eigenvalues(air.damping).minCoeff(), -1e-14 * air.damping.norm());
    }
}

TEST(AirDrag, WindCarriesAClothThatMovesWithIt) {
    const Sheet sheet = one_diagonal_sheet(3, 3, 1, 1);
    const AirElements air(cloth_of(sheet), {.wind = {1.0, 2.0, 3.0}, .air_density = 1.2});
    const auto x = placed(sheet, [](const Vec2& m) { return Vec3(m.x(), m.y(), m.x() * m.y()); });
    const std::vector<Vec3> v(x.size(), Vec3(1.0, 2.0, 3.0));
    std::vector<Vec3> f(3 * air.size());
    std::vector<Mat3> blocks(6 * air.size());

    air.evaluate(x, v, {1.0, 1.0}, f, blocks);

    for (const Vec3& force : f) {
        EXPECT_EQ(force.norm(), 0.0);
    }
}

TEST(AirDrag, CollapsedFacesFeelNothing) {
    const AirForce air = air_drag(Vec3::Zero(), Vec3(1, 2, 3), 1.2);

    EXPECT_EQ(air.force, Vec3::Zero());
    EXPECT_EQ(air.damping, Mat3::Zero());
}

} // namespace weft
