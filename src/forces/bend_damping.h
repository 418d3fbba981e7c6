#pragma once

#include "forces/elements.h"

namespace weft {

/// Force -c dtheta/dt grad theta of one hinge on (x0, x1, x2, x3) and scales.damping times its
/// matrix c grad grad^T; no elastic part. Zero for every rigid motion, without torque, positive
/// semidefinite.
///
/// @param damping     c, N m s, >= 0
/// @param least_area  m^2: the gradient of a hinge whose triangles have collapsed below this is
///                    scaled down, because it grows as one over their heights
ElementTerms<4> hinge_damping_terms(const std::array<Vec3, 4>& x,
                                    const std::array<Vec3, 4>& v,
                                    double damping,
                                    double least_area,
                                    SystemScales scales);

/// Damping of bending over a whole cloth: a hinge an edge with c = tau D L^2 / (A0 + A1), tau the
/// fabric's stiffness damping; on the boundary c = 0 and all nodes are k_no_index. The constant
/// matrix of the elastic part cannot serve for this: -tau Q v brakes the rotation of a bent sheet.
class BendDampingElements : public ElementLoops<BendDampingElements, 4> {
public:
    /// No elements when the fabric's damping or rigidity is zero.
    explicit BendDampingElements(const Cloth& cloth);

    std::vector<Index> remesh(const Cloth& cloth, const ClothChanges& changes);

    ElementTerms<4> terms_of(std::size_t hinge,
                             std::span<const Vec3> x,
                             std::span<const Vec3> v,
                             SystemScales scales) const;

private:
    struct Hinge {
        double damping;    ///< N m s
        double least_area; ///< m^2
    };
    void resize(const Cloth& cloth);
    void set_hinge(const Cloth& cloth, Index edge);

    double stiffness_; ///< tau D, N m s
    std::vector<Hinge> hinges_;
};

} // namespace weft
