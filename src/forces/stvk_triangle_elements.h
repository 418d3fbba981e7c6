#pragma once

#include "forces/stvk_triangle.h"
#include "state/cloth_changes.h"

#include <span>
#include <vector>

namespace weft {

/// The Saint Venant-Kirchhoff triangles of a whole cloth (see forces/element_terms.h).
class StvkTriangleElements {
public:
    static constexpr int k_nodes = 3;

    explicit StvkTriangleElements(const Cloth& cloth);

    /// Cloth of this model does not adapt: no slots.
    std::vector<Index> update(const Cloth&, const ClothChanges&) { return {}; }

    std::size_t size() const { return rest_.size(); }
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
    Corners corners(std::size_t t, std::span<const Vec3> values) const;

    MembraneStiffness stiffness_;
    double damping_; ///< N s/m
    std::vector<RestTriangle> rest_;
    std::vector<Index> nodes_;
};

} // namespace weft
