#pragma once

#include "base/eigen.h"
#include "geometry/distance.h"

#include <array>

namespace weft {

/// A pair that is near when a substep starts, or meets during it, so that the implicit solve can
/// carry it. The relative displacement of its sides over the substep is the sum of weight times
/// vertex displacement plus `obstacle_displacement`.
struct Contact {
    std::array<Index, 4> pair; ///< which pair of the contact surface it is
    PairKind kind;
    std::array<Index, 4> vertices; ///< indices in World; k_no_index where an obstacle stands
    std::array<double, 4> weights; ///< as in Separation
    Vec3 normal;                   ///< unit; the sides part along it
    double gap;                    ///< between the sides along the normal, at the start, m
    double thickness;              ///< wanted gap, m
    double rest_gap;               ///< the pair pushes only while its gap is smaller, m
    double barrier_width;          ///< by which pushing sides may come nearer than rest_gap, m
    double mass;                   ///< that a push along the normal moves, kg
    double friction;               ///< Coulomb, kinetic
    double static_friction;        ///< Coulomb, while it sticks
    Vec3 obstacle_displacement;    ///< what obstacles add to the relative displacement, m
    Vec3 slip = Vec3::Zero();      ///< tangential displacement of the friction spring, m; at the
                                   ///< start, once the solve has reported it at the end
    bool slides = false;           ///< friction is kinetic
    bool met = false;              ///< found by continuous detection, not near at the start
    double impulse = 0.0;          ///< along the normal, from the solve, N s, >= 0
    Vec3 friction_impulse = Vec3::Zero(); ///< tangential, from the solve, N s
};

/// Normal force of a contact, by the approach: how much smaller than its rest gap the gap is.
///
///     force = k s / (1 - s / S)    0 <= s <= 0.8 S, then on along the tangent
///
/// with s the approach, S the barrier's width: linear while loads are light, and stiffer without
/// bound as the width is used up, like a logarithmic barrier, but finite at any approach so that a
/// solve may begin anywhere. Convex: the force never falls with s. For friction see friction.h.
struct NormalLaw {
    double stiffness;     ///< k, N/m
    double barrier_width; ///< S, m, > 0

    double force(double approach) const;   ///< N, >= 0
    double tangent(double approach) const; ///< d force / d approach, N/m, >= 0
    double energy(double approach) const;  ///< J, integral of the force from 0
};

} // namespace weft
