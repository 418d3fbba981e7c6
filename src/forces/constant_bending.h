#pragma once

#include "forces/elements.h"

namespace weft {

/// Edges that an adaptation changed, or one of whose triangles it changed: those whose bending is
/// another one, as slots of the cloth as it is now, ascending, each once.
std::vector<Index> changed_hinges(const Cloth& cloth, const ClothChanges& changes);

/// One stencil of a cloth's bending by itself (forces/elements.h says what elements have). Rows of
/// its matrix sum to zero.
struct BendElement {
    int count = 0;                      ///< nodes, 4 or 6; 0: the cloth does not bend
    std::array<Index, 6> nodes{};       ///< the first `count`; k_no_index: none there
    std::array<double, 21> stiffness{}; ///< block_count(count) of Q, upper triangle, N/m

    /// No element: the cloth does not bend there.
    bool empty() const { return count == 0 || nodes[0] == k_no_index; }
    Index node(int a) const { return nodes[at(a)]; }
    bool has(int a) const { return node(a) != k_no_index; }
    double q(int a, int b) const {
        return stiffness[block_index(count, std::min(a, b), std::max(a, b))];
    }

    /// Derivative of the energy by the position of node a, N.
    /// @param x  #V of the cloth, m
    Vec3 gradient(int a, std::span<const Vec3> x) const;

    /// 1/2 sum Q_ab x_a.x_b, J.
    double energy(std::span<const Vec3> x) const;

    /// Calls f(node, force in N) for each node.
    template <typename F> void for_each_force(std::span<const Vec3> x, const F& f) const {
        for (int a = 0; a < count; ++a) {
            if (has(a)) {
                f(node(a), Vec3(-gradient(a, x)));
            }
        }
    }
};

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

    /// Slots are edges of BendModel::Quadratic, triangles of BendModel::MidEdge; there are none
    /// when the cloth does not bend.
    static std::size_t slot_count(const Cloth& cloth);
    static std::vector<Index> changed_slots(const Cloth& cloth, const ClothChanges& changes);
    static BendElement element(const Cloth& cloth, Index slot);
    std::vector<Index> remesh(const Cloth& cloth, const ClothChanges& changes);

    int nodes_per_element() const { return nodes_per_element_; } ///< 4 or 6
    std::size_t size() const { return nodes_.size() / at(nodes_per_element_); }
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

    int nodes_per_element_;
    std::vector<Index> nodes_;
    std::vector<double> stiffness_;
};

} // namespace weft
