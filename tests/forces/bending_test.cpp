#include "forces/constant_bending.h"
#include "support/sheets.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

namespace weft {

using namespace test;

namespace {

constexpr double k_rigidity = 2e-5;

FabricParams fabric() {
    return {.bend_stiffness = k_rigidity};
}

/// The plane wrapped on a cylinder of curvature kappa, bent along the direction at `degrees` to x.
std::function<Vec3(const Vec2&)> cylinder(double kappa, double degrees) {
    const Vec2 along(std::cos(degrees * M_PI / 180.0), std::sin(degrees * M_PI / 180.0));
    const Vec2 across(-along.y(), along.x());
    return [=](const Vec2& m) {
        const double s = along.dot(m);
        return Vec3(std::sin(kappa * s) / kappa, across.dot(m),
                    (1.0 - std::cos(kappa * s)) / kappa);
    };
}

/// Energy on a cylinder over 1/2 D kappa^2 area, in the middle half of the sheet where no stencil
/// touches the border.
double relative_energy(const Sheet& sheet, BendModel model, double degrees) {
    const double kappa = 0.2;
    const Cloth cloth = cloth_of(sheet, fabric(), model);
    const ConstantBending bending(cloth);
    const auto x = placed(sheet, cylinder(kappa, degrees));
    std::vector<Vec3> f(bending.nodes().size());
    bending.forces(x, f);
    const auto n = static_cast<std::size_t>(bending.nodes_per_element());
    Vec2 low = sheet.points.front(), high = sheet.points.front();
    for (const Vec2& p : sheet.points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    // A square window on the mean place of the element's nodes that cuts no pattern in two.
    const Vec2 window_low = low + 0.25 * (high - low);
    const Vec2 window_high = low + 0.75 * (high - low);
    double energy = 0.0;
    for (std::size_t e = 0; e < bending.size(); ++e) {
        const Index* nodes = &bending.nodes()[e * n];
        const std::size_t core = n == 4 ? 2 : 3; // the edge, or the triangle
        Vec2 centre = Vec2::Zero();
        for (std::size_t a = 0; a < core; ++a) {
            centre += sheet.points[static_cast<std::size_t>(nodes[a])] / static_cast<double>(core);
        }
        double weight = 1.0; // an edge on the window's border stands half inside
        for (int axis = 0; axis < 2; ++axis) {
            const double inside =
                std::min(centre(axis) - window_low(axis), window_high(axis) - centre(axis));
            weight *= inside > 1e-9 ? 1.0 : inside > -1e-9 ? 0.5 : 0.0;
        }
        for (std::size_t a = 0; a < n && weight > 0.0; ++a) {
            if (nodes[a] != k_no_index) {
                energy -= weight * 0.5 * f[e * n + a].dot(x[static_cast<std::size_t>(nodes[a])]);
            }
        }
    }
    const Vec2 extent = window_high - window_low;
    return energy / (0.5 * k_rigidity * kappa * kappa * extent.prod());
}

} // namespace

TEST(Bending, MidEdgeIsExactOnCylindersOverRegularMeshes) {
    for (const double degrees : {0.0, 30.0, 45.0, 90.0, 135.0}) {
        EXPECT_NEAR(relative_energy(one_diagonal_sheet(16, 16, 1, 1), BendModel::MidEdge, degrees),
                    1.0, 1e-3)
            << degrees;
    }
}

TEST(Bending, HingesCostThreeTimesAlongTheDiagonals) {
    // With k = D/3: on a square grid with one diagonal the stencil sees the curvature along the
    // diagonals threefold, and exactly once along an axis.
    const Sheet sheet = one_diagonal_sheet(16, 16, 1, 1);

    EXPECT_NEAR(relative_energy(sheet, BendModel::Quadratic, 0.0), 1.0, 0.01);
    EXPECT_NEAR(relative_energy(sheet, BendModel::Quadratic, 45.0), 3.0, 0.03);
    EXPECT_NEAR(relative_energy(sheet, BendModel::Quadratic, 135.0), 1.0, 0.04);
}

TEST(Bending, CylinderEnergyOnUnionJackGrids) {
    const Sheet sheet = union_jack_sheet(16, 16, 1, 1);

    EXPECT_NEAR(relative_energy(sheet, BendModel::Quadratic, 0.0), 1.0, 0.01);
    EXPECT_NEAR(relative_energy(sheet, BendModel::Quadratic, 45.0), 1.5, 0.02);
    EXPECT_NEAR(relative_energy(sheet, BendModel::MidEdge, 0.0), 1.0, 0.01);
    EXPECT_NEAR(relative_energy(sheet, BendModel::MidEdge, 45.0), 1.5, 0.02);
}

} // namespace weft
