#pragma once

#include "scene/params.h"

#include <span>

namespace weft {

struct Contact;
struct ContactObject;

// Friction, and where each part of it is decided:
//
// - the coefficients of two objects: friction_between(), when the contact surface is made;
// - static or kinetic: is_sliding(); asked of a pair that is new when it is found
//   (contact_search.cpp), of all pairs when a substep ends (step/contact_forces.cpp), and handed to
//   the next substep (friction_history.h);
// - the limit, the coefficient times the normal force: friction_limit(), fitted to the solve
//   (step/contact_forces.cpp);
// - the force in the implicit solve: FrictionLaw;
// - impulses of what still meets after the solve: limit_friction_impulse(), kinetic
//   (contact_row.cpp).

/// Speed (m/s) above which friction is kinetic: below it contacts settle and share their load, by
/// way of slips too small to count as sliding (Stribeck's curve as a step).
inline constexpr double k_sliding_speed = 1e-3;

/// Does a pair slide that slips by `distance` (m) in the time `dt` (s)?
inline bool is_sliding(double distance, double dt) {
    return distance > k_sliding_speed * dt;
}

/// Coulomb's coefficients of two objects.
struct FrictionCoefficients {
    double kinetic;  ///< while they slide
    double sticking; ///< static: while they stick; >= kinetic
};

/// What the table says of two objects; where it does not name them, the geometric mean of their own
/// coefficients.
FrictionCoefficients friction_between(const ContactObject& a,
                                      const ContactObject& b,
                                      std::span<const FrictionPair> table);

/// Greatest force (N) of friction while the sides push with `normal_force` (N).
double friction_limit(const Contact& contact, double normal_force);

/// An impulse of friction (N s), cut down to the limit in its own direction.
Vec3 limit_friction_impulse(const Vec3& impulse, double limit);

/// Coulomb friction as an elastic-plastic spring in the plane of contact: a spring of `stiffness`
/// up to the force `limit`, and that limit beyond. The displacement counts from where the spring is
/// free, so that what sticks does not creep, whatever the step.
/// Source: return mapping as in plasticity; Wriggers, Computational Contact Mechanics, 2006, ch. 10
struct FrictionLaw {
    double stiffness; ///< N/m
    double limit;     ///< N, >= 0

    bool slides(const Vec3& displacement) const { return stiffness * displacement.norm() > limit; }
    Vec3 force(const Vec3& displacement) const;   ///< N, against it
    Mat3 tangent(const Vec3& displacement) const; ///< - d force / d displacement; PSD
    /// Between the tangent (damping 0), which along a slide is zero, and the stiffness of the
    /// paraboloid that touches the energy there and lies above it everywhere (damping 1): steps
    /// with it never overshoot back into sticking.
    Mat3 damped_tangent(const Vec3& displacement, double damping) const;
    double energy(const Vec3& displacement) const;
    /// The displacement that the spring keeps once what is beyond the limit has slid off.
    Vec3 kept(const Vec3& displacement) const;
};

} // namespace weft
