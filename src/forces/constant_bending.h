#pragma once

#include "forces/element_terms.h"
#include "state/cloth.h"
#include "state/cloth_changes.h"

#include <span>
#include <vector>

namespace weft {

/// Bending of a whole cloth with a constant matrix: energy 1/2 sum Q_ab x_a.x_b over stencils,
/// force -Q x, stiffness Q times the 3×3 identity; see forces/bending.h. Since Q never changes it
/// may be assembled once.
class ConstantBending {
public:
    /// BendModel::Quadratic: a four-node stencil (v0, v1, apex 0, apex 1) an edge; all k_no_index
    /// on the boundary.
    /// BendModel::MidEdge: a six-node stencil a triangle (corners, then the apexes across the edges
    /// opposite to them; k_no_index where the edge has no neighbour). No elements when the fabric's
    /// bending rigidity is zero.
    explicit ConstantBending(const Cloth& cloth);

    /// As forces/element_terms.h says of every set.
    std::vector<Index> update(const Cloth& cloth, const ClothChanges& changes);

    int nodes_per_element() const { return nodes_per_element_; } ///< 4 or 6
    std::size_t size() const {
        return nodes_.size() / static_cast<std::size_t>(nodes_per_element_);
    }
    std::span<const Index> nodes() const { return nodes_; }

    /// Q of each element, block_count(nodes_per_element()) scalars, upper triangle, N/m.
    std::span<const double> stiffness() const { return stiffness_; }

    /// Elastic energy at positions x (#V of the cloth, m), J.
    double energy(std::span<const Vec3> x) const;

    /// Forces on the nodes of each element, N; zero for missing nodes.
    void forces(std::span<const Vec3> x, std::span<Vec3> element_forces) const;

private:
    void resize(const Cloth& cloth);
    void set_element(const Cloth& cloth, Index slot);

    BendModel model_;
    bool is_stiff_;
    int nodes_per_element_;
    std::vector<Index> nodes_;
    std::vector<double> stiffness_;
};

} // namespace weft
