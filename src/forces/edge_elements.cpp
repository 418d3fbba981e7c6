#include "forces/edge_elements.h"

#include <cassert>

namespace weft {

namespace {

/// A limit's force as a multiple of the weight of the whole object. Larger: the step solves longer;
/// smaller: less load than 18 times this multiple of the weight, on one edge, takes an edge out.
constexpr double k_limit_weights = 4.0;

StretchLimit limit_of(const SpringParams& params) {
    if (params.limit == Vec2(0.0, 0.0)) {
        return {};
    }
    return {params.limit[0], params.limit[1], k_limit_weights * k_earth_gravity * params.mass};
}

} // namespace

EdgeElements::EdgeElements(const EdgeNetwork& network, Model model, const SpringParams& params)
    : law_{law_shape(model, params), params.damping,
           model == Model::Cubic ? params.jacobian_damping : 1.0, limit_of(params)},
      bend_law_{{}, params.damping, 1.0, {}} {
    nodes_.reserve(2 * network.size());
    const auto add = [&](bool is_bending) {
        for (const NetworkEdge& edge : network) {
            if ((edge.kind == EdgeKind::Bending) == is_bending) {
                assert(edge.rest_length > 0.0 && edge.stiffness > 0.0);
                nodes_.insert(nodes_.end(), edge.vertices.begin(), edge.vertices.end());
                stiffness_.push_back(edge.stiffness);
                rest_lengths_.push_back(edge.rest_length);
            }
        }
    };
    add(false);
    bending_begin_ = stiffness_.size();
    add(true);
}

double EdgeElements::bending_energy(std::span<const Vec3> x) const {
    return parallel_sum(size() - bending_begin_,
                        [&](std::size_t i) { return energy_of(bending_begin_ + i, x); });
}

} // namespace weft
