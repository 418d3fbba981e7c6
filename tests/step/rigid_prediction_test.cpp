#include "step/advance.h"
#include "step/rigid_prediction.h"
#include "support/worlds.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

namespace weft {

using namespace test;

namespace {

constexpr double k_turn = 2.0 * std::numbers::pi;

Scene scene_of(const RigidParams& rigid) {
    Scene scene;
    scene.rigids.push_back(rigid);
    scene.scene.gravity.setZero();
    return scene;
}

RigidParams brick(const Vec3& spin_deg) {
    RigidParams rigid;
    rigid.name = "brick";
    rigid.shape = Shape::Box;
    rigid.size = Vec3(0.3, 0.1, 0.2);
    rigid.mass = 2.0;
    rigid.spin_deg = spin_deg;
    return rigid;
}

double kinetic(const World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += 0.5 * world.masses[i] * world.velocities[i].squaredNorm();
    }
    return sum;
}

/// Rotation of a free body after `time`, by tiny steps of Euler's equations in the body's frame.
Mat3 reference_rotation(const Mat3& inertia, const Vec3& turning, double time) {
    const Mat3 inverse = inertia.inverse();
    const int steps = 200000;
    const double h = time / steps;
    Vec3 w = turning;
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    const auto slope = [&](const Vec3& at) { return Vec3(inverse * (inertia * at).cross(at)); };
    for (int i = 0; i < steps; ++i) {
        const Vec3 middle = w + 0.5 * h * slope(w);
        w += h * slope(middle);
        q = (q * Eigen::Quaterniond(Eigen::AngleAxisd(h * middle.norm(), middle.normalized())))
                .normalized();
    }
    return q.toRotationMatrix();
}

double most_strain(const World& world) {
    const RigidBody& rigid = world.rigids[0];
    const FourPoints x = particles_of(rigid, world.positions);
    double most = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double rest = (rigid.rest[i] - rigid.rest[j]).norm();
            most = std::max(most, std::abs((x[i] - x[j]).norm() / rest - 1.0));
        }
    }
    return most;
}

} // namespace

/// Ten turns about the axis of intermediate inertia, which is unstable, so that it tumbles.
TEST(RigidStep, ATumblingBrickKeepsEnergyAndAngularMomentum) {
    const Scene scene = scene_of(brick({3.0, 360.0, 3.0}));
    World world = build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    const double energy = kinetic(world);
    const Vec3 momentum = angular_momentum(world);

    for (int frame = 0; frame < 250; ++frame) {
        stepper.advance_frame(world, {});
    }

    EXPECT_NEAR(kinetic(world), energy, 1e-7 * energy);
    EXPECT_LT((angular_momentum(world) - momentum).norm(), 1e-8 * momentum.norm());
    EXPECT_LT(most_strain(world), 1e-12);
}

TEST(RigidStep, ATumblingBrickGoesTheWayOfEulersEquations) {
    const RigidParams params = brick({3.0, 360.0, 3.0});
    const FourPoints rest =
        particles_with((params.size.cwiseProduct(params.size) / 12.0).asDiagonal());
    const Vec3 turning = params.spin_deg / 360.0 * k_turn;
    const Mat3 inertia = inertia_of(rest);

    FourPoints x = rest;
    FourPoints v = rigid_velocities(x, {Vec3::Zero(), inertia * turning});
    const double time = 4.0;
    for (int i = 0; i < 400; ++i) {
        const RigidPrediction prediction = predict_rigid(rest, x, v, time / 400);
        x = prediction.positions;
        v = prediction.velocities;
    }

    const Mat3 expected = reference_rotation(inertia, turning, time);
    EXPECT_LT((nearest_pose(rest, x).rotation - expected).norm(), 1e-4);
}

TEST(RigidStep, ASphereSpinsAsLongAsItFliesFreely) {
    RigidParams ball = brick({0.0, 0.0, 720.0});
    ball.shape = Shape::Sphere;
    ball.velocity = Vec3(1.0, 2.0, 0.0);
    Scene scene = scene_of(ball);
    scene.scene.gravity = Vec3(0.0, -9.81, 0.0);
    World world = build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    const FourPoints start = particles_of(world.rigids[0], world.positions);

    for (int frame = 0; frame < 25; ++frame) {
        stepper.advance_frame(world, {});
    }

    // implicit Euler: g h^2 n (n + 1) / 2, here of 100 substeps of 10 ms
    const Vec3 way(1.0, 2.0 - 9.81 * 1e-4 * 100 * 101 / 2.0, 0.0);
    const Pose pose =
        nearest_pose(world.rigids[0].rest, particles_of(world.rigids[0], world.positions));
    EXPECT_LT((pose.translation - way).norm(), 1e-9);
    for (std::size_t i = 0; i < 4; ++i) { // two turns
        EXPECT_LT((pose * start[i] - pose.translation - start[i]).norm(), 1e-6);
    }
}

} // namespace weft
