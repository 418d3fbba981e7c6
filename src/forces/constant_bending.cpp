#include "forces/constant_bending.h"

#include "base/parallel.h"
#include "forces/bending.h"

#include <algorithm>
#include <cassert>

namespace weft {

namespace {

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// Rest corners of triangle t, turned so that vertex `first` comes first.
RestCorners corners_from(const Cloth& cloth, Index t, Index first) {
    const Triangle& triangle = cloth.triangles[at(t)];
    const RestCorners corners = rest_corners(cloth.rest[at(t)]);
    const auto k = static_cast<std::size_t>(std::find(triangle.begin(), triangle.end(), first) -
                                            triangle.begin());
    assert(k < 3);
    return {corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]};
}

void add_hinges(const Cloth& cloth, std::vector<Index>& nodes, std::vector<double>& stiffness) {
    for (const MeshEdge& edge : cloth.topology.edges) {
        if (edge.is_boundary()) {
            continue;
        }
        // turned to (apex, v0, v1) and (apex, v1, v0)
        const RestCorners left = corners_from(cloth, edge.triangle[0], edge.apex[0]);
        const RestCorners right = corners_from(cloth, edge.triangle[1], edge.apex[1]);
        const auto jump = edge_jump({rest_cotangent(left, 1), rest_cotangent(right, 2)},
                                    {rest_cotangent(left, 2), rest_cotangent(right, 1)});
        const auto q = hinge_bend_stiffness(
            jump, cloth.rest[at(edge.triangle[0])].area + cloth.rest[at(edge.triangle[1])].area,
            cloth.params.fabric.bend_stiffness);
        nodes.insert(nodes.end(), {edge.v[0], edge.v[1], edge.apex[0], edge.apex[1]});
        stiffness.insert(stiffness.end(), q.begin(), q.end());
    }
}

void add_patches(const Cloth& cloth, std::vector<Index>& nodes, std::vector<double>& stiffness) {
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        const Triangle& triangle = cloth.triangles[t];
        BendPatch patch{};
        patch.corners = rest_corners(cloth.rest[t]);
        nodes.insert(nodes.end(), triangle.begin(), triangle.end());
        for (std::size_t k = 0; k < 3; ++k) {
            const MeshEdge& edge = cloth.topology.edges[at(cloth.topology.triangle_edges[t][k])];
            const std::size_t other = edge.triangle[0] == static_cast<Index>(t) ? 1 : 0;
            patch.has_neighbour[k] = !edge.is_boundary();
            if (patch.has_neighbour[k]) {
                patch.neighbours[k] = corners_from(cloth, edge.triangle[other], edge.apex[other]);
            }
            nodes.push_back(patch.has_neighbour[k] ? edge.apex[other] : k_no_index);
        }
        const auto q = mid_edge_bend_stiffness(patch, cloth.params.fabric.bend_stiffness);
        stiffness.insert(stiffness.end(), q.begin(), q.end());
    }
}

/// Calls f(a, b, Q_ab) for the whole symmetric matrix of one element.
template <typename F> void for_each_entry(int n, std::span<const double> q, const F& f) {
    for (int a = 0; a < n; ++a) {
        for (int b = a; b < n; ++b) {
            const double value = q[block_index(n, a, b)];
            f(static_cast<std::size_t>(a), static_cast<std::size_t>(b), value);
            if (a != b) {
                f(static_cast<std::size_t>(b), static_cast<std::size_t>(a), value);
            }
        }
    }
}

} // namespace

ConstantBending::ConstantBending(const Cloth& cloth)
    : nodes_per_element_(cloth.params.bend_model == BendModel::Quadratic ? 4 : 6) {
    assert(cloth.rest.size() == cloth.triangles.size());
    if (cloth.params.fabric.bend_stiffness <= 0.0) {
        return;
    }
    switch (cloth.params.bend_model) {
    case BendModel::Quadratic:
        add_hinges(cloth, nodes_, stiffness_);
        break;
    case BendModel::MidEdge:
        add_patches(cloth, nodes_, stiffness_);
        break;
    }
}

void ConstantBending::forces(std::span<const Vec3> x, std::span<Vec3> element_forces) const {
    assert(element_forces.size() == nodes_.size());
    const int n = nodes_per_element_;
    const auto count = static_cast<std::size_t>(n);
    const auto entries = static_cast<std::size_t>(block_count(n));
    parallel_for(size(), [&](std::size_t e) {
        const Index* nodes = &nodes_[e * count];
        // Relative to the first node: the rows of Q sum to zero, and far from the origin nothing
        // is lost.
        const Vec3& origin = x[at(nodes[0])];
        std::array<Vec3, 6> relative;
        for (std::size_t a = 0; a < count; ++a) {
            relative[a] = nodes[a] == k_no_index ? Vec3::Zero() : Vec3(x[at(nodes[a])] - origin);
            element_forces[e * count + a] = Vec3::Zero();
        }
        for_each_entry(n, {&stiffness_[e * entries], entries},
                       [&](std::size_t a, std::size_t b, double q) {
                           element_forces[e * count + a] -= q * relative[b];
                       });
    });
}

double ConstantBending::energy(std::span<const Vec3> x) const {
    const int n = nodes_per_element_;
    const auto count = static_cast<std::size_t>(n);
    const auto entries = static_cast<std::size_t>(block_count(n));
    return parallel_sum(size(), [&](std::size_t e) {
        const Index* nodes = &nodes_[e * count];
        const Vec3& origin = x[at(nodes[0])];
        double twice = 0.0;
        for_each_entry(
            n, {&stiffness_[e * entries], entries}, [&](std::size_t a, std::size_t b, double q) {
                if (nodes[a] != k_no_index && nodes[b] != k_no_index) {
                    twice += q * (x[at(nodes[a])] - origin).dot(x[at(nodes[b])] - origin);
                }
            });
        return 0.5 * twice;
    });
}

} // namespace weft
