#pragma once

#include "forces/edge_law.h"
#include "state/cloth.h"
#include "state/cloth_changes.h"
#include "state/edge_network.h"

#include <span>
#include <vector>

namespace weft {

/// The edges of one object, cloth or solid (see forces/element_terms.h): those that resist
/// stretching, each with the law of the model, then those that resist bending. A bending edge is a
/// Hookean spring in all models and has no limit: cloth may fold.
class EdgeElements {
public:
    static constexpr int k_nodes = 2;
    static constexpr bool k_is_difference = true;

    EdgeElements(const EdgeNetwork& network, Model model, const SpringParams& params);

    /// Networks do not change: no slots.
    std::vector<Index> update(const Cloth&, const ClothChanges&) { return {}; }

    std::size_t size() const { return stiffness_.size(); }
    std::span<const Index> nodes() const { return nodes_; }

    double energy(std::span<const Vec3> x) const;         ///< of all edges, J
    double bending_energy(std::span<const Vec3> x) const; ///< of the bending edges alone, J

    void
    forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> element_forces) const;
    void evaluate(std::span<const Vec3> x,
                  std::span<const Vec3> v,
                  SystemScales scales,
                  std::span<Vec3> element_forces,
                  std::span<Mat3> element_blocks) const;

private:
    const EdgeLaw& law(std::size_t edge) const { return edge < bending_begin_ ? law_ : bend_law_; }
    Vec3 difference(std::size_t edge, std::span<const Vec3> values) const;
    double energy(std::span<const Vec3> x, std::size_t begin) const;

    EdgeLaw law_, bend_law_;
    std::size_t bending_begin_ = 0; ///< the first bending edge
    std::vector<Index> nodes_;
    std::vector<double> stiffness_, rest_lengths_; ///< N/m, m
};

} // namespace weft
