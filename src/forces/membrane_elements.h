#pragma once

#include "forces/membrane_hessian.h"
#include "state/cloth_changes.h"

#include <span>
#include <vector>

namespace weft {

/// The membrane of a whole cloth: one element a triangle (see forces/element_terms.h).
class MembraneElements {
public:
    static constexpr int k_nodes = 3;

    explicit MembraneElements(const Cloth& cloth);

    std::vector<Index> update(const Cloth& cloth, const ClothChanges& changes);

    std::size_t size() const { return rest_.size(); }
    std::span<const Index> nodes() const { return nodes_; }

    /// Elastic energy at positions x (#V of the cloth, m), J.
    double energy(std::span<const Vec3> x) const;

    /// Elastic and damping force on the corners, 3*#T, N.
    void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> element_forces) const;

    /// The same, and the system blocks, 6*#T.
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> element_forces,
                  std::span<Mat3> element_blocks) const;

private:
    MembraneStiffness stiffness_;
    double damping_time_;
    std::vector<RestTriangle> rest_;
    std::vector<Index> nodes_;
};

} // namespace weft
