#include "forces/rigid_elements.h"
#include "support/derivatives.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

/// Particles of a box whose edges are far from equal.
const FourPoints k_rest = particles_with(Vec3(0.01, 0.09, 0.3).asDiagonal());
constexpr double k_stiffness = 300.0;

/// The four particles in a random pose, each pushed aside by about `strain` m.
VecX strained(double strain, std::mt19937& random) {
    std::normal_distribution<double> normal;
    VecX x = flat<4>(posed(k_rest, {random_rotation(random), Vec3(1.0, -2.0, 3.0)}));
    for (double& value : x) {
        value += strain * normal(random);
    }
    return x;
}

ElementTerms<4> terms_at(const VecX& x) {
    return rigid_terms(corners<4>(x), k_rest, k_stiffness);
}

} // namespace

TEST(RigidElement, ForceIsTheSlopeOfItsEnergy) {
    std::mt19937 random(1);
    for (const double strain : {0.0, 1e-3, 0.05}) {
        const VecX x = strained(strain, random);

        const VecX slope =
            numerical_gradient([](const VecX& at) { return terms_at(at).energy; }, x, 1e-5);

        EXPECT_LT((slope + flat<4>(terms_at(x).force)).norm(), 1e-7) << strain;
    }
}

TEST(RigidElement, MatrixIsTheSlopeOfItsForceWhereNothingIsStrained) {
    std::mt19937 random(2);
    const VecX x = strained(0.0, random);

    const MatX K = assembled<4>(terms_at(x).stiffness);

    const MatX slope =
        numerical_jacobian([](const VecX& at) { return flat<4>(terms_at(at).force); }, x, 1e-6);
    EXPECT_LT((K + slope).norm(), 1e-6 * k_stiffness);
}

TEST(RigidElement, MatrixHoldsSixMotionsAndLetsSixGo) {
    std::mt19937 random(3);
    const MatX K = assembled<4>(terms_at(strained(0.02, random)).stiffness);

    const VecX values = eigenvalues(K);

    for (Eigen::Index i = 0; i < 6; ++i) {
        EXPECT_NEAR(values[i], 0.0, 1e-10);
        EXPECT_NEAR(values[i + 6], k_stiffness, 1e-10);
    }
}

TEST(RigidElement, ForcesSumToZeroAndHaveNoTorque) {
    std::mt19937 random(4);
    const VecX x = strained(0.05, random);

    const ElementTerms<4> terms = terms_at(x);

    Vec3 sum = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
    for (int i = 0; i < 4; ++i) {
        sum += terms.force[at(i)];
        torque += x.segment<3>(3 * i).cross(terms.force[at(i)]);
    }
    EXPECT_GT(terms.force[0].norm(), 1.0);
    EXPECT_LT(sum.norm(), 1e-12);
    EXPECT_LT(torque.norm(), 1e-11);
}

} // namespace weft
