#pragma once

#include "forces/element_terms.h"
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
class RigidElements {
public:
    static constexpr int k_nodes = 4;

    explicit RigidElements(const World& world);

    std::size_t size() const { return rests_.size(); }
    std::span<const Index> nodes() const { return nodes_; }
    double energy(std::span<const Vec3> x) const;
    void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> element_forces) const;
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> element_forces,
                  std::span<Mat3> element_blocks) const;

private:
    ElementTerms<4> terms(std::size_t body, std::span<const Vec3> x) const;

    std::vector<FourPoints> rests_;
    std::vector<double> stiffness_; ///< N/m
    std::vector<Index> nodes_;
};

} // namespace weft
