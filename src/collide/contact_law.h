#pragma once

#include "base/eigen.h"

namespace weft {

/// How one contact pushes along its normal, by how far the sides have come nearer than the distance
/// at which they part freely.
///
///     force = k s / (1 - s / S)    0 <= s <= 0.8 S, then on along the tangent
///
/// with s the approach, S the room: linear while loads are light, and stiffer without bound as the
/// room is used up, like a logarithmic barrier, but finite at any approach so that a solve may
/// begin anywhere. Convex: the force never falls with s.
struct NormalLaw {
    double stiffness; ///< k, N/m
    double room;      ///< S, m, > 0

    double force(double approach) const;   ///< N, >= 0
    double tangent(double approach) const; ///< d force / d approach, N/m, >= 0
    double energy(double approach) const;  ///< J, integral of the force from 0
};

/// Coulomb friction as an elastic-plastic spring across the normal: a spring of `stiffness` up to
/// the force `limit`, and that limit beyond. The displacement counts from where the spring is free,
/// so that what sticks does not creep, whatever the step.
/// Source: return mapping as in plasticity; Wriggers, Computational Contact Mechanics, 2006, ch. 10
struct FrictionLaw {
    double stiffness; ///< N/m
    double limit;     ///< N, >= 0

    bool slides(const Vec3& displacement) const { return stiffness * displacement.norm() > limit; }
    Vec3 force(const Vec3& displacement) const;   ///< N, against it
    Mat3 tangent(const Vec3& displacement) const; ///< - d force / d displacement; PSD
    /// Between the tangent (0), which along a slide is zero, and the stiffness of the paraboloid
    /// that touches the energy there and lies above it everywhere (1): steps with it never
    /// overshoot back into sticking.
    Mat3 damped_tangent(const Vec3& displacement, double caution) const;
    double energy(const Vec3& displacement) const;
    /// The displacement that the spring keeps once what is beyond the limit has slid off.
    Vec3 kept(const Vec3& displacement) const;
};

} // namespace weft
