#pragma once

#include "forces/elements.h"
#include "state/world.h"

namespace weft {

/// A thread between two points of cloth. It pulls, and never pushes, with
///
///     T(d) = min(stiffness * max(0, d - rest_gap), limit)
///
/// at distance d, and along itself is damped while it is taut.
struct Thread {
    double rest_gap = 0.0;  ///< m, >= 0
    double stiffness = 0.0; ///< N/m; 0: it hangs loose
    double limit = 0.0;     ///< N; infinite: none
    double damping = 0.0;   ///< damping of the rate of d - rest_gap, N s/m
    double rest_rate = 0.0; ///< rate of rest_gap, m/s
};

/// Energy, forces and scales.stiffness * K + scales.damping * D of a thread on the vertices whose
/// weighted sum (AttachedPair) is its gap. Forces sum to zero and have no torque.
///
/// K is the Hessian of the energy, which is convex, so it is positive semidefinite. Along a thread
/// that pulls at its limit it is limit / (d - rest_gap) instead of 0: with no stiffness at all a
/// step would carry the ends past each other, again and again; with this one, whose parabola lies
/// above the energy, it carries them no further than the rest gap.
///
/// @param weights sum to 0; 0 for a missing vertex, whose position does not matter
ElementTerms<6> thread_terms(const std::array<Vec3, 6>& x,
                             const std::array<Vec3, 6>& v,
                             const std::array<double, 6>& weights,
                             const Thread& thread,
                             SystemScales scales);

/// All attached pairs of a world, with the world's own vertex indices.
class AttachmentElements : public ElementLoops<AttachmentElements, 6> {
public:
    explicit AttachmentElements(const World& world);

    /// Threads as they are in a substep that ends at `end_time` (s).
    void set(const World& world, double end_time);

    double energy_of(std::size_t pair, std::span<const Vec3> x) const;
    ElementTerms<6> terms_of(std::size_t pair,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    std::vector<AttachedPair> pairs_;
    std::vector<double> masses_; ///< #pairs, that one end moves against the other, kg
    std::vector<Thread> threads_;
};

} // namespace weft
