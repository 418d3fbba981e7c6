#include "state/rigid_motion.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

Vec3 centre_of(const FourPoints& points) {
    return 0.25 * (points[0] + points[1] + points[2] + points[3]);
}

} // namespace

FourPoints particles_of(const RigidBody& rigid, std::span<const Vec3> values) {
    const auto first = static_cast<std::size_t>(rigid.body.first_particle);
    return {values[first], values[first + 1], values[first + 2], values[first + 3]};
}

Pose nearest_pose(const FourPoints& rest, const FourPoints& positions) {
    const Vec3 centre = centre_of(positions);
    Mat3 A = Mat3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        A += (positions[i] - centre) * rest[i].transpose();
    }
    const Eigen::JacobiSVD<Mat3> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0.0) {
        U.col(2) = -U.col(2);
    }
    return {U * svd.matrixV().transpose(), centre};
}

Mat3 inertia_of(const FourPoints& points) {
    const Vec3 centre = centre_of(points);
    Mat3 sum = Mat3::Zero();
    for (const Vec3& x : points) {
        const Vec3 r = x - centre;
        sum += 0.25 * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    }
    return sum;
}

FourPoints posed(const FourPoints& rest, const Pose& pose) {
    return {pose * rest[0], pose * rest[1], pose * rest[2], pose * rest[3]};
}

RigidMotion motion_of(const FourPoints& positions, const FourPoints& velocities) {
    RigidMotion motion{centre_of(velocities), Vec3::Zero()};
    const Vec3 centre = centre_of(positions);
    for (std::size_t i = 0; i < 4; ++i) {
        motion.specific_angular_momentum +=
            0.25 * (positions[i] - centre).cross(velocities[i] - motion.velocity);
    }
    return motion;
}

Vec3 angular_velocity(const FourPoints& positions, const RigidMotion& motion) {
    return inertia_of(positions).ldlt().solve(motion.specific_angular_momentum);
}

FourPoints rigid_velocities(const FourPoints& positions, const RigidMotion& motion) {
    const Vec3 turning = angular_velocity(positions, motion);
    const Vec3 centre = centre_of(positions);
    FourPoints velocities;
    for (std::size_t i = 0; i < 4; ++i) {
        velocities[i] = motion.velocity + turning.cross(positions[i] - centre);
    }
    return velocities;
}

Vec3 spin_of(const Mat3& inertia, const Vec3& angular_momentum, double least_inertia) {
    constexpr double k_least_fraction = 1e-9;
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(inertia);
    const double least = std::max(least_inertia, k_least_fraction * axes.eigenvalues()[2]);
    Vec3 spin = Vec3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) {
        if (axes.eigenvalues()[k] > least) {
            const Vec3 axis = axes.eigenvectors().col(k);
            spin += axis.dot(angular_momentum) / axes.eigenvalues()[k] * axis;
        }
    }
    return spin;
}

FourPoints particles_with(const Mat3& second_moments) {
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(second_moments);
    assert(axes.eigenvalues()[0] > 0.0);
    const Mat3 spread = axes.eigenvectors() * axes.eigenvalues().cwiseSqrt().asDiagonal();
    return {spread * Vec3(1.0, 1.0, 1.0), spread * Vec3(1.0, -1.0, -1.0),
            spread * Vec3(-1.0, 1.0, -1.0), spread * Vec3(-1.0, -1.0, 1.0)};
}

/// w_i = 1/4 + X_i . D^-1 x / 4, where D, the mean of X_i X_i^T, has the rest's second moments.
std::array<double, 4> embedding_weights(const FourPoints& rest, const Vec3& x) {
    Mat3 moments = Mat3::Zero();
    for (const Vec3& X : rest) {
        moments += 0.25 * X * X.transpose();
    }
    const Vec3 y = moments.ldlt().solve(x);
    std::array<double, 4> weights{};
    for (std::size_t i = 0; i < 4; ++i) {
        weights[i] = 0.25 + 0.25 * rest[i].dot(y);
    }
    return weights;
}

} // namespace weft
