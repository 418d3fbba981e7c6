#include "forces/bending.h"
#include "forces/constant_bending.h"
#include "support/derivatives.h"
#include "support/sheets.h"

#include <Eigen/Cholesky>
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
    const auto n = at(bending.nodes_per_element());
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
        if (nodes[0] == k_no_index) {
            continue; // the slot of a boundary edge
        }
        const std::size_t core = n == 4 ? 2 : 3; // the edge, or the triangle
        Vec2 centre = Vec2::Zero();
        for (std::size_t a = 0; a < core; ++a) {
            centre += sheet.points[at(nodes[a])] / static_cast<double>(core);
        }
        double weight = 1.0; // an edge on the window's border stands half inside
        for (int axis = 0; axis < 2; ++axis) {
            const double inside =
                std::min(centre(axis) - window_low(axis), window_high(axis) - centre(axis));
            weight *= inside > 1e-9 ? 1.0 : inside > -1e-9 ? 0.5 : 0.0;
        }
        for (std::size_t a = 0; a < n && weight > 0.0; ++a) {
            if (nodes[a] != k_no_index) {
                energy -= weight * 0.5 * f[e * n + a].dot(x[at(nodes[a])]);
            }
        }
    }
    const Vec2 extent = window_high - window_low;
    return energy / (0.5 * k_rigidity * kappa * kappa * extent.prod());
}

/// The whole matrix, on scalar heights.
Eigen::MatrixXd assembled(const ConstantBending& bending, const Sheet& sheet) {
    const auto count = static_cast<Eigen::Index>(sheet.points.size());
    const int n = bending.nodes_per_element();
    Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(count, count);
    for (std::size_t e = 0; e < bending.size(); ++e) {
        const Index* nodes = &bending.nodes()[e * at(n)];
        for (int a = 0; a < n; ++a) {
            for (int b = 0; b < n; ++b) {
                if (nodes[a] != k_no_index && nodes[b] != k_no_index) {
                    Q(nodes[a], nodes[b]) +=
                        bending.stiffness()[e * at(block_count(n)) +
                                            block_index(n, std::min(a, b), std::max(a, b))];
                }
            }
        }
    }
    return Q;
}

/// Mean deflection of the far end (greatest x) of a sheet with rigidity 1 and load 1 per area whose
/// points up to x = clamped are held.
double tip_deflection(const Sheet& sheet, BendModel model, double clamped) {
    const Cloth cloth = cloth_of(sheet, {.bend_stiffness = 1.0}, model);
    Eigen::MatrixXd Q = assembled(ConstantBending(cloth), sheet);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(Q.rows());
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        for (const Index v : cloth.triangles[t]) {
            load(v) += cloth.rest[t].area / 3.0;
        }
    }
    double end = 0.0;
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        end = std::max(end, sheet.points[i].x());
        if (sheet.points[i].x() < clamped + 1e-9) {
            Q.row(row).setZero();
            Q.col(row).setZero();
            Q(row, row) = 1.0;
            load(row) = 0.0;
        }
    }
    const Eigen::VectorXd deflection = Q.ldlt().solve(load);
    double sum = 0.0;
    int points = 0;
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        if (sheet.points[i].x() > end - 1e-9) {
            sum += deflection(static_cast<Eigen::Index>(i));
            ++points;
        }
    }
    return sum / points;
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
    // 1.5 with the pure mid-edge weights
    EXPECT_NEAR(relative_energy(sheet, BendModel::MidEdge, 45.0), 1.3, 0.01);
}

TEST(Bending, MidEdgeIsExactOnEquilateralMeshesInEveryDirection) {
    // The window of relative_energy would cut the pattern: compare directions instead.
    const Sheet sheet = equilateral_sheet(24, 24, 0.05);
    const double along = relative_energy(sheet, BendModel::MidEdge, 0.0);

    for (const double degrees : {20.0, 45.0, 90.0, 130.0}) {
        EXPECT_NEAR(relative_energy(sheet, BendModel::MidEdge, degrees), along, 1e-3) << degrees;
    }
}

TEST(Bending, HingeAngleOfAnIsometricFoldIsTheJump) {
    // |K x| = 2 L sin(theta / 2); two right triangles folded by 1 rad about an edge of length 2
    const double angle = 1.0, length = 2.0;
    const RestCorners left{Vec2(0, 0), Vec2(2, 0), Vec2(0.4, 1.5)};
    const RestCorners right{Vec2(0, 0), Vec2(1.3, -0.8), Vec2(2, 0)};
    const auto jump = edge_jump({rest_cotangent(left, 0), rest_cotangent(right, 0)},
                                {rest_cotangent(left, 1), rest_cotangent(right, 2)});

    const Vec3 sum = jump[1] * Vec3(2, 0, 0) + jump[2] * Vec3(0.4, 1.5, 0) +
                     jump[3] * Vec3(1.3, -0.8 * std::cos(angle), 0.8 * std::sin(angle));

    EXPECT_NEAR(sum.norm(), 2.0 * length * std::sin(angle / 2), 1e-14);
}

TEST(Bending, CantileverSagsAsThePlateDoes) {
    // q L^4 / (8 D), L half a cell longer because the hinge on the clamp bends over half a cell
    // only
    const int n = 20;
    const double cell = 1.0 / n;
    const double plate = std::pow(1.0 + cell / 2, 4) / 8.0;
    const double length = 1.0 + cell;
    const Sheet diagonal = one_diagonal_sheet(n + 1, n / 2, length, 0.5);
    const Sheet union_jack = union_jack_sheet(n + 1, n / 2, length, 0.5);
    const Sheet irregular = irregular_sheet(n + 1, n / 2, length, 0.5, 0.3, 1);
    const Sheet very_irregular = irregular_sheet(n + 1, n / 2, length, 0.5, 0.45, 2);

    EXPECT_NEAR(tip_deflection(diagonal, BendModel::MidEdge, cell), plate, 0.005 * plate);
    EXPECT_NEAR(tip_deflection(union_jack, BendModel::MidEdge, cell), plate, 0.02 * plate);
    EXPECT_NEAR(tip_deflection(irregular, BendModel::MidEdge, cell), plate, 0.02 * plate);
    EXPECT_NEAR(tip_deflection(very_irregular, BendModel::MidEdge, cell), plate, 0.03 * plate);
    // Hinges are up to a fifth too soft here: their bending Poisson ratio is -1/3.
    EXPECT_NEAR(tip_deflection(diagonal, BendModel::Quadratic, cell), plate, 0.2 * plate);
    EXPECT_GT(tip_deflection(diagonal, BendModel::Quadratic, cell), 1.1 * plate);
}

TEST(Bending, StretchingAndTurningAFlatSheetCostsNothing) {
    const Sheet sheet = irregular_sheet(8, 8, 1, 1, 0.4, 4);
    Mat32 F;
    F << 1.3, 0.2, -0.4, 0.8, 0.1, 0.9;
    for (const BendModel model : {BendModel::Quadratic, BendModel::MidEdge}) {
        const ConstantBending bending(cloth_of(sheet, fabric(), model));
        const auto x = placed(sheet, [&](const Vec2& m) { return Vec3(F * m); });
        std::vector<Vec3> f(bending.nodes().size());

        bending.forces(x, f);

        for (const Vec3& force : f) {
            EXPECT_LT(force.norm(), 1e-12 * k_rigidity * 64.0);
        }
        EXPECT_LT(bending.energy(x), 1e-20 * k_rigidity);
    }
}

TEST(Bending, ForceIsTheGradientAndSumsToNothing) {
    const Sheet sheet = irregular_sheet(4, 4, 1, 1, 0.4, 5);
    for (const BendModel model : {BendModel::Quadratic, BendModel::MidEdge}) {
        const ConstantBending bending(cloth_of(sheet, fabric(), model));
        auto x = placed(sheet, [](const Vec2& m) {
            return Vec3(m.x(), m.y(), std::sin(9.0 * m.x()) * std::cos(7.0 * m.y()));
        });
        std::vector<Vec3> f(bending.nodes().size()), gathered(x.size(), Vec3::Zero());

        bending.forces(x, f);

        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        double scale = 0.0;
        for (std::size_t i = 0; i < f.size(); ++i) {
            if (bending.nodes()[i] == k_no_index) {
                EXPECT_EQ(f[i], Vec3::Zero());
                continue;
            }
            const auto vertex = at(bending.nodes()[i]);
            gathered[vertex] += f[i];
            sum += f[i];
            torque += x[vertex].cross(f[i]);
            scale += f[i].norm();
        }
        EXPECT_LT(sum.norm(), 1e-14 * scale);
        EXPECT_LT(torque.norm(), 1e-14 * scale);
        for (std::size_t i = 0; i < x.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const double at = x[i](axis);
                x[i](axis) = at + 1e-4; // the energy is quadratic: central differences are exact
                const double above = bending.energy(x);
                x[i](axis) = at - 1e-4;
                const double below = bending.energy(x);
                x[i](axis) = at;
                EXPECT_NEAR(gathered[i](axis), -(above - below) / 2e-4, 1e-9 * scale);
            }
        }
    }
}

TEST(Bending, MatrixIsPositiveSemidefinite) {
    const Sheet sheet = irregular_sheet(5, 5, 1, 1, 0.45, 6);
    for (const BendModel model : {BendModel::Quadratic, BendModel::MidEdge}) {
        const Eigen::MatrixXd Q =
            assembled(ConstantBending(cloth_of(sheet, fabric(), model)), sheet);

        const Eigen::VectorXd values = eigenvalues(Q);

        EXPECT_GT(values(0), -1e-12 * values.maxCoeff());
        // Affine functions cost nothing, and nothing else does.
        EXPECT_LT(values(2), 1e-12 * values.maxCoeff());
        EXPECT_GT(values(3), 1e-6 * values.maxCoeff());
    }
}

TEST(Bending, NoRigidityMeansNoElements) {
    const ConstantBending bending(
        cloth_of(one_diagonal_sheet(2, 2, 1, 1), {.bend_stiffness = 0.0}));

    EXPECT_EQ(bending.size(), 0U);
    EXPECT_EQ(bending.energy(std::vector<Vec3>(9, Vec3::Zero())), 0.0);
}

} // namespace weft
