#pragma once

#include "forces/elements.h"
#include "state/rigid_motion.h"
#include "state/world.h"

namespace weft {

/// Energy, forces and stiffness that hold the four particles of a rigid body in their places to
/// each other:
///
///     W = k/2 sum_i |x_i - c - R X_i|^2      c, R: of the nearest pose
///
/// Unchanged by rigid motions; forces sum to zero and have no torque. The stiffness is k times the
/// projector that takes rigid velocities away, the Hessian where nothing is strained; it is
/// positive semidefinite everywhere, with no eigenvalue but 0 and k.
/// Source: shape matching of Mueller et al. 2005 as an energy.
ElementTerms<4> rigid_terms(const FourPoints& x, const FourPoints& rest, double stiffness);

/// All rigid bodies of a world, with the world's own vertex indices.
class RigidElements : public ElementLoops<RigidElements, 4> {
public:
    explicit RigidElements(const World& world);

    double energy_of(std::size_t body, std::span<const Vec3> x) const;
    ElementTerms<4> terms_of(std::size_t body,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    std::vector<FourPoints> rests_;
    std::vector<double> stiffness_; ///< N/m
};

} // namespace weft
