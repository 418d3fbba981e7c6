#include "forces/cloth_forces.h"
#include "remesh/vertex_energy.h"
#include "support/adapting_world.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace weft {

namespace {

using test::AdaptingWorld;
using test::SheetMotion;

/// A refined sheet.
struct RefinedSheet {
    explicit RefinedSheet(SheetMotion motion, BendModel model, double bend_stiffness) {
        AdaptingWorld sheets(motion, 5);
        for (int adaptation = 0; adaptation < 4; ++adaptation) {
            sheets.adapt(0, 8, 1.0);
        }
        cloth = sheets.world.cloths[0];
        cloth.params.bend_model = model;
        cloth.params.fabric.bend_stiffness = bend_stiffness;
        const auto places = sheets.world.positions_of(cloth);
        x.assign(places.begin(), places.end());
        stars = VertexStars(cloth.triangles, cloth.vertex_count);
    }

    Cloth cloth;
    std::vector<Vec3> x;
    VertexStars stars;
};

struct BendingModel {
    BendModel bend;
    double stiffness;
};

class VertexEnergyOf : public testing::TestWithParam<BendingModel> {};

} // namespace

TEST_P(VertexEnergyOf, HasTheForceOfTheWholeCloth) {
    RefinedSheet sheet(SheetMotion::Crumple, GetParam().bend, GetParam().stiffness);
    BendElements bends(sheet.cloth);
    constexpr double k_step = 1e-6; // m
    for (Index v = 0; v < sheet.cloth.vertex_count; v += 3) {
        const VertexEnergy around(sheet.cloth, sheet.stars, v, bends);
        const Vec3 force = around.force(sheet.x);
        Vec3& place = sheet.x[static_cast<std::size_t>(v)];
        for (int axis = 0; axis < 3; ++axis) {
            const double kept = place[axis];
            place[axis] = kept + k_step;
            const double ahead = elastic_energy(sheet.cloth, sheet.x);
            place[axis] = kept - k_step;
            const double behind = elastic_energy(sheet.cloth, sheet.x);
            place[axis] = kept;
            EXPECT_NEAR(force[axis], -(ahead - behind) / (2.0 * k_step),
                        1e-6 * (1.0 + force.norm()));
        }
    }
}

TEST_P(VertexEnergyOf, KnowsWhatAShiftChanges) {
    RefinedSheet sheet(SheetMotion::Crumple, GetParam().bend, GetParam().stiffness);
    BendElements bends(sheet.cloth);
    const Vec3 shift(0.004, -0.007, 0.002); // m
    for (Index v = 0; v < sheet.cloth.vertex_count; v += 3) {
        const VertexEnergy around(sheet.cloth, sheet.stars, v, bends);
        const double before = elastic_energy(sheet.cloth, sheet.x);
        const double membrane = around.membrane(sheet.x);
        const double bending = around.bending_change(sheet.x, shift);
        sheet.x[static_cast<std::size_t>(v)] += shift;
        EXPECT_NEAR(around.membrane(sheet.x) - membrane + bending,
                    elastic_energy(sheet.cloth, sheet.x) - before, 1e-9 * (1.0 + before));
        sheet.x[static_cast<std::size_t>(v)] -= shift;
    }
}

/// Where nothing is strained the stiffness given is the second derivative; elsewhere it is never
/// negative.
TEST_P(VertexEnergyOf, HasTheStiffnessOfClothAtRest) {
    RefinedSheet sheet(SheetMotion::Spin, GetParam().bend, GetParam().stiffness);
    BendElements bends(sheet.cloth);
    constexpr double k_step = 1e-7; // m
    for (Index v = 0; v < sheet.cloth.vertex_count; v += 3) {
        const VertexEnergy around(sheet.cloth, sheet.stars, v, bends);
        Mat3 stiffness;
        around.force(sheet.x, &stiffness);
        Mat3 difference;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3& place = sheet.x[static_cast<std::size_t>(v)];
            const double kept = place[axis];
            place[axis] = kept + k_step;
            const Vec3 ahead = around.force(sheet.x);
            place[axis] = kept - k_step;
            difference.col(axis) = (around.force(sheet.x) - ahead) / (2.0 * k_step);
            place[axis] = kept;
        }
        EXPECT_LT((stiffness - difference).norm(), 1e-5 * stiffness.norm());
    }
}

TEST_P(VertexEnergyOf, HasNoNegativeStiffness) {
    RefinedSheet sheet(SheetMotion::Crumple, GetParam().bend, GetParam().stiffness);
    BendElements bends(sheet.cloth);
    for (Index v = 0; v < sheet.cloth.vertex_count; ++v) {
        Mat3 stiffness;
        VertexEnergy(sheet.cloth, sheet.stars, v, bends).force(sheet.x, &stiffness);
        const Eigen::SelfAdjointEigenSolver<Mat3> axes(stiffness);
        EXPECT_GT(axes.eigenvalues()[0], -1e-9 * axes.eigenvalues()[2]);
    }
}

INSTANTIATE_TEST_SUITE_P(Models,
                         VertexEnergyOf,
                         testing::Values(BendingModel{BendModel::Quadratic, 1e-3},
                                         BendingModel{BendModel::MidEdge, 1e-3},
                                         BendingModel{BendModel::MidEdge, 0.0}));

} // namespace weft
