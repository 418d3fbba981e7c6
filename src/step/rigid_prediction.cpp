#include "step/rigid_prediction.h"

#include <Eigen/Geometry>

#include <cmath>

namespace weft {

namespace {

/// Radians a piece. Larger: a tumbling body drifts from its path; smaller: more pieces.
constexpr double k_piece = 0.05;

/// Pieces at most: what turns faster is as good as lost anyway.
constexpr double k_most_pieces = 4096.0;

using Coefficients = Eigen::Vector4d; ///< a quaternion as x y z w

/// dq/dt = turning q / 2 where the body at rotation q turns with its angular momentum.
Coefficients rate(const FourPoints& rest, const RigidMotion& motion, const Coefficients& q) {
    const Mat3 R = Eigen::Quaterniond(q).normalized().toRotationMatrix();
    const Vec3 turning = angular_velocity(posed(rest, {R, Vec3::Zero()}), motion);
    const Eigen::Quaterniond product =
        Eigen::Quaterniond(0.0, turning.x(), turning.y(), turning.z()) * Eigen::Quaterniond(q);
    return 0.5 * product.coeffs();
}

Mat3 turn_freely(const FourPoints& rest, const RigidMotion& motion, const Mat3& R, double dt) {
    const double speed = angular_velocity(posed(rest, {R, Vec3::Zero()}), motion).norm();
    const double pieces = std::clamp(std::ceil(speed * dt / k_piece), 1.0, k_most_pieces);
    const double h = dt / pieces;
    Coefficients q = Eigen::Quaterniond(R).coeffs();
    for (int i = 0; i < static_cast<int>(pieces); ++i) {
        const Coefficients k1 = rate(rest, motion, q);
        const Coefficients k2 = rate(rest, motion, q + 0.5 * h * k1);
        const Coefficients k3 = rate(rest, motion, q + 0.5 * h * k2);
        const Coefficients k4 = rate(rest, motion, q + h * k3);
        q = (q + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)).normalized();
    }
    return Eigen::Quaterniond(q).toRotationMatrix();
}

} // namespace

RigidPrediction predict_rigid(const FourPoints& rest,
                              const FourPoints& positions,
                              const FourPoints& velocities,
                              double dt) {
    Pose pose = nearest_pose(rest, positions);
    const RigidMotion motion = motion_of(positions, velocities);
    pose.translation += dt * motion.velocity;
    if (!motion.specific_angular_momentum.isZero(0.0)) {
        pose.rotation = turn_freely(rest, motion, pose.rotation, dt);
    }
    RigidPrediction prediction;
    prediction.positions = posed(rest, pose);
    prediction.velocities = rigid_velocities(prediction.positions, motion);
    return prediction;
}

RigidPrediction project_to_rigid(const FourPoints& rest,
                                 const RigidPrediction& prediction,
                                 const FourPoints& positions,
                                 const FourPoints& velocities) {
    RigidPrediction end;
    end.positions = posed(rest, nearest_pose(rest, positions));
    end.velocities = rigid_velocities(end.positions, motion_of(prediction.positions, velocities));
    return end;
}

} // namespace weft
