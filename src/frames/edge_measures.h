#pragma once

#include "forces/edge_law.h"
#include "state/edge_network.h"

#include <span>
#include <vector>

namespace weft {

/// Whether stretch is that of edges.
constexpr bool has_edge_law(Model model) {
    return model == Model::Cubic || model == Model::Linear || model == Model::StvkEdge;
}

/// How an edge is stretched: its length over its rest length.
struct EdgeStretch {
    std::size_t edge; ///< of the network
    double stretch;
};

/// Of all edges that resist stretching, sides and diagonals, in the network's order.
/// @param x  positions of the object's vertices or particles, m
std::vector<EdgeStretch> edge_stretches(const EdgeNetwork& network, std::span<const Vec3> x);

/// Means over the edges at each vertex, `count` long; without edges 1 and 0.
struct VertexEdgeMeasures {
    std::vector<float> stretch;
    std::vector<float> tension; ///< of the law over rest length, N/m
};
VertexEdgeMeasures measure_edges(const EdgeNetwork& network,
                                 const LawShape& shape,
                                 std::span<const Vec3> x,
                                 std::size_t count);

} // namespace weft
