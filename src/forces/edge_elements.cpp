#include "forces/edge_elements.h"

#include "base/parallel.h"
#include "forces/edge_kernel.h"

#include <cassert>

namespace weft {

namespace {

constexpr double k_earth_gravity = 9.81; // m/s^2

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

Vec3 EdgeElements::difference(std::size_t edge, std::span<const Vec3> values) const {
    return values[static_cast<std::size_t>(nodes_[2 * edge])] -
           values[static_cast<std::size_t>(nodes_[2 * edge + 1])];
}

double EdgeElements::energy(std::span<const Vec3> x, std::size_t begin) const {
    return parallel_sum(size() - begin, [&](std::size_t i) {
        const std::size_t e = begin + i;
        const EdgeKernel kernel(law(e), stiffness_[e], rest_lengths_[e], difference(e, x));
        return kernel.energy(law(e), stiffness_[e], rest_lengths_[e]);
    });
}

double EdgeElements::energy(std::span<const Vec3> x) const {
    return energy(x, 0);
}

double EdgeElements::bending_energy(std::span<const Vec3> x) const {
    return energy(x, bending_begin_);
}

void EdgeElements::forces(std::span<const Vec3> x,
                          std::span<const Vec3> v,
                          std::span<Vec3> element_forces) const {
    assert(element_forces.size() == 2 * size());
    parallel_for(size(), [&](std::size_t e) {
        const EdgeKernel kernel(law(e), stiffness_[e], rest_lengths_[e], difference(e, x));
        const Vec3 force = kernel.force(law(e), difference(e, v));
        element_forces[2 * e] = force;
        element_forces[2 * e + 1] = -force;
    });
}

void EdgeElements::evaluate(std::span<const Vec3> x,
                            std::span<const Vec3> v,
                            SystemScales scales,
                            std::span<Vec3> element_forces,
                            std::span<Mat3> element_blocks) const {
    assert(element_forces.size() == 2 * size() && element_blocks.size() == size());
    parallel_for(size(), [&](std::size_t e) {
        const EdgeLaw& edge_law = law(e);
        const EdgeKernel kernel(edge_law, stiffness_[e], rest_lengths_[e], difference(e, x));
        const Vec3 force = kernel.force(edge_law, difference(e, v));
        element_forces[2 * e] = force;
        element_forces[2 * e + 1] = -force;
        element_blocks[e] = kernel.block(edge_law, stiffness_[e], rest_lengths_[e], scales);
    });
}

} // namespace weft
