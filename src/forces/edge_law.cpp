#include "forces/edge_law.h"

#include <cassert>

namespace weft {

CubicCoefficients cubic_coefficients(const LawShape& shape, double stiffness, double rest_length) {
    const auto [p, q] = shape;
    const double L = rest_length;
    return {stiffness * q / (3.0 * L * L), stiffness * (p - 2.0 * q) / (2.0 * L),
            stiffness * (1.0 - p + q), -stiffness * L * (1.0 - p / 2.0 + q / 3.0)};
}

namespace {

/// Fraction of the way to where a limit has no bound, from which on its force is linear.
constexpr double k_straight = 0.95;

/// Distance past a limit at which its force has no bound, as a fraction of the limit.
constexpr double k_limit_width = 0.01;

/// Energy over force and width, force, and its derivative by u.
EdgeResponse wall(double u) {
    const double w = std::min(u, k_straight);
    const double rest = 1.0 - w;
    const double force = w * w / rest;
    const double slope = w * (2.0 - w) / (rest * rest);
    const double beyond = u - w;
    return {-0.5 * w * w - w - std::log1p(-w) + beyond * (force + 0.5 * beyond * slope),
            force + beyond * slope, slope};
}

} // namespace

EdgeResponse limit_response(const StretchLimit& limit, double rest_length, double s) {
    const bool is_long = s > limit.greatest;
    if (limit.force == 0.0 || (!is_long && s >= limit.least)) {
        return {};
    }
    const double bound = is_long ? limit.greatest : limit.least;
    const double width = k_limit_width * bound;
    const EdgeResponse unit = wall((is_long ? s - bound : bound - s) / width);
    return {limit.force * width * rest_length * unit.energy,
            (is_long ? limit.force : -limit.force) * unit.tension,
            limit.force / (width * rest_length) * unit.stiffness};
}

ElementTerms<2> edge_terms(const std::array<Vec3, 2>& x,
                           const std::array<Vec3, 2>& v,
                           double stiffness,
                           double rest_length,
                           const EdgeLaw& law,
                           SystemScales scales) {
    const EdgeKernel kernel(law, stiffness, rest_length, x[0] - x[1]);
    ElementTerms<2> terms;
    terms.energy = kernel.energy(law, stiffness, rest_length);
    const Vec3 force = kernel.force(law, v[0] - v[1]);
    terms.force = {force, Vec3(-force)};
    const Mat3 block = kernel.block(law, stiffness, rest_length, scales);
    terms.stiffness = {block, Mat3(-block), block};
    return terms;
}

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
