#include "forces/attachment_elements.h"
#include "support/derivatives.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

/// A point inside a triangle against one on an edge.
const std::array<double, 6> k_weights{0.2, 0.5, 0.3, -0.6, -0.4, 0.0};

/// Two ends at random whose gap is `gap` long.
VecX points_apart(double gap, std::mt19937& random) {
    std::normal_distribution<double> normal;
    VecX x(18);
    for (double& value : x) {
        value = normal(random);
    }
    Vec3 between = Vec3::Zero();
    for (int i = 0; i < 6; ++i) {
        between += k_weights[at(i)] * x.segment<3>(3 * i);
    }
    const Vec3 shift = (gap / between.norm() - 1.0) * between;
    for (int i = 0; i < 3; ++i) {
        x.segment<3>(3 * i) += shift;
    }
    return x;
}

ElementTerms<6> terms_at(const VecX& x, const Thread& thread) {
    return thread_terms(corners<6>(x), corners<6>(VecX::Zero(18)), k_weights, thread, {1.0, 0.0});
}

/// Slack, on the way to the limit, and beyond it; with and without length.
struct Case {
    double gap;
    Thread thread;
};
const std::vector<Case> k_cases{
    {0.3, {.rest_gap = 0.5, .stiffness = 40.0, .limit = 8.0}},
    {0.6, {.rest_gap = 0.5, .stiffness = 40.0, .limit = 8.0}},
    {1.4, {.rest_gap = 0.5, .stiffness = 40.0, .limit = 8.0}},
    {0.1, {.rest_gap = 0.0, .stiffness = 40.0, .limit = 8.0}},
    {1.4, {.rest_gap = 0.0, .stiffness = 40.0, .limit = 8.0}},
};

} // namespace

TEST(Thread, ForceIsTheSlopeOfItsEnergy) {
    std::mt19937 random(2);
    for (const Case& c : k_cases) {
        const VecX x = points_apart(c.gap, random);

        const VecX slope = numerical_gradient(
            [&](const VecX& at) { return terms_at(at, c.thread).energy; }, x, 1e-5);

        EXPECT_LT((slope + flat<6>(terms_at(x, c.thread).force)).norm(), 1e-8) << c.gap;
    }
}

TEST(Thread, MatrixIsTheSlopeOfItsForceAndPositiveSemidefinite) {
    std::mt19937 random(3);
    for (const Case& c : k_cases) {
        const VecX x = points_apart(c.gap, random);

        const MatX K = assembled<6>(terms_at(x, c.thread).stiffness);

        const MatX slope = numerical_jacobian(
            [&](const VecX& at) { return flat<6>(terms_at(at, c.thread).force); }, x, 1e-5);
        if (c.gap < 1.0) { // beyond the limit another one is meant
            EXPECT_LT((K + slope).norm(), 1e-7) << c.gap;
        }
        EXPECT_GT(eigenvalues(K).minCoeff(), -1e-13);
    }
}

TEST(Thread, AtItsLimitIsSeenToEndAtItsRestGap) {
    std::mt19937 random(7);
    for (const Case& c : {k_cases[2], k_cases[4]}) {
        const VecX x = points_apart(c.gap, random);
        const auto terms = terms_at(x, c.thread);
        Vec3 gap = Vec3::Zero();
        for (int i = 0; i < 6; ++i) {
            gap += k_weights[at(i)] * x.segment<3>(3 * i);
        }
        // vertex 0 alone moved so that the gap becomes the rest gap, along itself
        VecX move = VecX::Zero(18);
        move.head<3>() = (c.thread.rest_gap / gap.norm() - 1.0) / k_weights[0] * gap;

        const VecX left = flat<6>(terms.force) - assembled<6>(terms.stiffness) * move;

        EXPECT_NEAR(Vec3(left.head<3>()).norm(), 0.0, 1e-12);
    }
}

TEST(Thread, WithoutLengthIsAStiffSpringInAllWays) {
    const Thread thread{.stiffness = 40.0, .limit = 8.0};

    const auto terms = terms_at(VecX::Zero(18), thread);

    // weights 0.2 and -0.6 of vertices 0 and 3
    EXPECT_LT((terms.stiffness[block_index(6, 0, 3)] + 0.12 * 40.0 * Mat3::Identity()).norm(),
              1e-13);
    EXPECT_TRUE(flat<6>(terms.force).isZero(0.0));
}

TEST(Thread, PullsByItsLimitAtMostAndNeverPushes) {
    std::mt19937 random(4);
    const Thread thread{.rest_gap = 0.5, .stiffness = 40.0, .limit = 8.0};
    const auto force_on_side_a = [&](double gap) {
        const auto force = terms_at(points_apart(gap, random), thread).force;
        return (force[0] + force[1] + force[2]).norm();
    };

    EXPECT_EQ(force_on_side_a(0.49), 0.0);
    EXPECT_NEAR(force_on_side_a(0.6), 4.0, 1e-12);
    EXPECT_NEAR(force_on_side_a(7.0), 8.0, 1e-12);
}

TEST(Thread, HasNoForceOrTorqueInSum) {
    std::mt19937 random(5);
    const VecX x = points_apart(0.6, random);
    const VecX v = points_apart(2.0, random);
    const Thread thread{.rest_gap = 0.5, .stiffness = 40.0, .limit = 8.0, .damping = 3.0};

    const auto force = thread_terms(corners<6>(x), corners<6>(v), k_weights, thread, {}).force;

    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (int i = 0; i < 6; ++i) {
        sum += force[at(i)];
        torque += Vec3(x.segment<3>(3 * i)).cross(force[at(i)]);
    }
    EXPECT_GT(force[0].norm(), 0.1);
    EXPECT_LT(sum.norm(), 1e-14);
    EXPECT_LT(torque.norm(), 1e-13);
}

TEST(Thread, DampingBrakesOnlyTheChangeBeyondTheRamp) {
    const std::array<Vec3, 6> x{Vec3(1.0, 0.0, 0.0), Vec3::Zero(), Vec3::Zero(),
                                Vec3::Zero(),        Vec3::Zero(), Vec3::Zero()};
    std::array<Vec3, 6> v{};
    v.fill(Vec3::Zero());
    const std::array<double, 6> weights{1.0, 0.0, 0.0, -1.0, 0.0, 0.0};
    const Thread thread{
        .rest_gap = 0.9, .stiffness = 10.0, .limit = 100.0, .damping = 3.0, .rest_rate = -0.2};
    const auto pull = [&](double speed, double across) {
        v[0] = Vec3(speed, across, 0.0);
        return Vec3(thread_terms(x, v, weights, thread, {}).force[0]);
    };

    EXPECT_NEAR(pull(-0.2, 0.0).x(), -1.0, 1e-14); // as fast as the ramp: the spring alone
    EXPECT_NEAR(pull(0.3, 0.0).x(), -1.0 - 3.0 * 0.5, 1e-14);
    EXPECT_EQ(pull(0.3, 5.0), pull(0.3, 0.0));
}

TEST(Thread, BlocksOfItsDampingAreTheDerivativeByVelocity) {
    std::mt19937 random(6);
    const VecX x = points_apart(0.6, random);
    const Thread thread{.rest_gap = 0.5, .stiffness = 40.0, .limit = 8.0, .damping = 3.0};
    const auto force = [&](const VecX& v) {
        return flat<6>(
            thread_terms(corners<6>(x), corners<6>(v), k_weights, thread, {0.0, 1.0}).force);
    };

    const MatX D = assembled<6>(
        thread_terms(corners<6>(x), corners<6>(VecX::Zero(18)), k_weights, thread, {0.0, 1.0})
            .stiffness);

    EXPECT_LT((D + numerical_jacobian(force, VecX::Zero(18), 1e-3)).norm(), 1e-9);
    EXPECT_GT(D.norm(), 1.0);
}

} // namespace weft
