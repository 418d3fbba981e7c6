#pragma once

#include "forces/edge_law.h"
#include "state/body.h"
#include "state/cloth.h"
#include "state/edge_network.h"
#include "state/refinement.h"

namespace weft {

/// The edges of one object, cloth or solid: those that resist stretching, each with the law of the
/// model, then those that resist bending. A bending edge is a Hookean spring in all models and has
/// no limit: cloth may fold. Networks do not change.
class EdgeElements : public ElementLoops<EdgeElements, 2, 1> {
public:
    EdgeElements(const EdgeNetwork& network, Model model, const SpringParams& params);
    explicit EdgeElements(const Cloth& cloth)
        : EdgeElements(cloth.network, cloth.params.model, cloth.params.spring) {}
    explicit EdgeElements(const Solid& solid)
        : EdgeElements(solid.network, solid.params.model, solid.params.spring) {}

    double bending_energy(std::span<const Vec3> x) const; ///< energy of the bending edges alone, J

    double energy_of(std::size_t edge, std::span<const Vec3> x) const {
        return kernel(edge, x).energy(law(edge), stiffness_[edge], rest_lengths_[edge]);
    }
    std::array<Vec3, 2>
    force_of(std::size_t edge, std::span<const Vec3> x, std::span<const Vec3> v) const {
        const Vec3 force = kernel(edge, x).force(law(edge), difference(edge, v));
        return {force, Vec3(-force)};
    }
    ElementTerms<2, 1> terms_of(std::size_t edge,
                                std::span<const Vec3> x,
                                std::span<const Vec3> v,
                                SystemScales scales) const {
        const EdgeKernel at_work = kernel(edge, x);
        const Vec3 force = at_work.force(law(edge), difference(edge, v));
        ElementTerms<2, 1> terms;
        terms.force = {force, Vec3(-force)};
        terms.stiffness[0] =
            at_work.block(law(edge), stiffness_[edge], rest_lengths_[edge], scales);
        return terms;
    }

private:
    const EdgeLaw& law(std::size_t edge) const { return edge < bending_begin_ ? law_ : bend_law_; }
    Vec3 difference(std::size_t edge, std::span<const Vec3> values) const {
        return values[at(nodes_[2 * edge])] - values[at(nodes_[2 * edge + 1])];
    }
    EdgeKernel kernel(std::size_t edge, std::span<const Vec3> x) const {
        return {law(edge), stiffness_[edge], rest_lengths_[edge], difference(edge, x)};
    }

    EdgeLaw law_, bend_law_;
    std::size_t bending_begin_ = 0;                ///< the first bending edge
    std::vector<double> stiffness_, rest_lengths_; ///< N/m, m
};

} // namespace weft
