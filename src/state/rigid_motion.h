#pragma once

#include "scene/pose.h"
#include "state/body.h"

namespace weft {

/// The four particles of a rigid body.
using FourPoints = std::array<Vec3, 4>;

/// The values of a rigid body's particles in `values`, which is #V of World long.
FourPoints particles_of(const RigidBody& rigid, std::span<const Vec3> values);

/// The pose that brings `rest` nearest to four particles, in the least-squares sense; exact when
/// their distances to each other are those at rest.
Pose nearest_pose(const FourPoints& rest, const FourPoints& positions);
FourPoints posed(const FourPoints& rest, const Pose& pose);

/// Moments of inertia about the centre of a body of mass 1 that four particles represent, m^2.
Mat3 inertia_of(const FourPoints& positions);

/// Linear and angular momentum per mass: both stay constant when no force acts.
struct RigidMotion {
    Vec3 velocity;                  ///< velocity of the centre of mass, m/s
    Vec3 specific_angular_momentum; ///< angular momentum about the centre of mass over mass, m^2/s
};
RigidMotion motion_of(const FourPoints& positions, const FourPoints& velocities);

/// Velocities of particles at `positions` that move rigidly with `motion`.
FourPoints rigid_velocities(const FourPoints& positions, const RigidMotion& motion);

/// Angular velocity (rad/s) that gives particles at `positions` that angular momentum.
Vec3 angular_velocity(const FourPoints& positions, const RigidMotion& motion);

/// Angular velocity (rad/s) of least size that has the angular momentum (kg m^2/s) about a centre,
/// given the inertia about it (kg m^2). Directions with no inertia, as about a line of vertices,
/// stay without spin: those with at most `least_inertia`, or 1e-9 of the greatest.
Vec3 spin_of(const Mat3& inertia, const Vec3& angular_momentum, double least_inertia = 0.0);

/// Four points whose centre and second moments about it are those of a body of mass 1: with
/// them as particles of a quarter of its mass each, mass, centre, and moments of inertia are the
/// body's, and the inertial force of what is embedded in them is exact (affine body dynamics of Lan
/// et al. 2022, in the basis in which the mass matrix is diagonal).
///
/// @param second_moments  integral of x x^T over the mass, over the mass, m^2; positive definite
FourPoints particles_with(const Mat3& second_moments);

/// Weights that make the point x, relative to the centre, a weighted sum of the particles.
std::array<double, 4> embedding_weights(const FourPoints& rest, const Vec3& x);

} // namespace weft
