#include "state/rigid_motion.h"
#include "support/random_rotation.h"

#include <gtest/gtest.h>

namespace weft {

namespace {

const Mat3 k_moments = (Mat3() << 0.3, 0.1, 0.0, 0.1, 0.2, 0.05, 0.0, 0.05, 0.1).finished();

} // namespace

TEST(RigidMotion, FourParticlesHaveTheCentreAndMomentsOfTheBody) {
    const FourPoints X = particles_with(k_moments);

    Vec3 centre = Vec3::Zero();
    Mat3 moments = Mat3::Zero();
    for (const Vec3& x : X) {
        centre += 0.25 * x;
        moments += 0.25 * x * x.transpose();
    }
    EXPECT_LT(centre.norm(), 1e-15);
    EXPECT_LT((moments - k_moments).norm(), 1e-15);
    const Mat3 inertia = k_moments.trace() * Mat3::Identity() - k_moments;
    EXPECT_LT((inertia_of(X) - inertia).norm(), 1e-15);
}

/// The kinetic energy of a field of velocities that is linear in space is that of the particles
/// alone: integral of |A x + b|^2 over the mass.
TEST(RigidMotion, FourParticlesHaveTheKineticEnergyOfEveryLinearMotion) {
    const FourPoints X = particles_with(k_moments);
    std::mt19937 random(1);
    const Mat3 A = Mat3::NullaryExpr([&] { return std::normal_distribution<double>()(random); });
    const Vec3 b(1.0, 2.0, 3.0);

    double sum = 0.0;
    for (const Vec3& x : X) {
        sum += 0.25 * (A * x + b).squaredNorm();
    }

    EXPECT_NEAR(sum, (A * k_moments * A.transpose()).trace() + b.squaredNorm(), 1e-12);
}

TEST(RigidMotion, WeightsGiveBackThePointAndSumToOne) {
    const FourPoints X = particles_with(k_moments);
    const Vec3 x(0.7, -0.4, 1.3);

    const auto weights = embedding_weights(X, x);

    const Vec3 sum = weights[0] * X[0] + weights[1] * X[1] + weights[2] * X[2] + weights[3] * X[3];
    EXPECT_LT((sum - x).norm(), 1e-13);
    EXPECT_NEAR(weights[0] + weights[1] + weights[2] + weights[3], 1.0, 1e-14);
}

TEST(RigidMotion, TheNearestPoseOfAPosedBodyIsItsPose) {
    const FourPoints X = particles_with(k_moments);
    std::mt19937 random(5);
    for (int i = 0; i < 20; ++i) {
        const Pose pose{test::random_rotation(random), Vec3(3.0, -1.0, 2.0)};

        const Pose found = nearest_pose(X, posed(X, pose));

        EXPECT_LT((found.rotation - pose.rotation).norm(), 1e-13);
        EXPECT_LT((found.translation - pose.translation).norm(), 1e-14);
    }
}

TEST(RigidMotion, RigidVelocitiesHaveTheMotionTheyAreMadeOf) {
    const FourPoints X = particles_with(k_moments);
    const FourPoints any{Vec3(1.0, 0.0, 2.0), Vec3(0.0, 3.0, 1.0), Vec3(-1.0, 1.0, 0.0),
                         Vec3(2.0, 2.0, -3.0)};
    const RigidMotion motion = motion_of(X, any);

    const FourPoints rigid = rigid_velocities(X, motion);

    EXPECT_LT((motion_of(X, rigid).velocity - motion.velocity).norm(), 1e-14);
    EXPECT_LT(
        (motion_of(X, rigid).specific_angular_momentum - motion.specific_angular_momentum).norm(),
        1e-14);
    for (std::size_t i = 0; i < 4; ++i) { // distances do not change
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NEAR((X[i] - X[j]).dot(rigid[i] - rigid[j]), 0.0, 1e-13);
        }
    }
}

} // namespace weft
