#pragma once

#include "forces/edge_law.h"
#include "forces/membrane.h"
#include "state/edge_network.h"
#include "state/world.h"

#include <span>
#include <vector>

namespace weft {

/// How each triangle of a cloth is strained, #T long: what statistics and pictures show.
std::vector<StrainMeasures> measure_triangles(const World& world, const Cloth& cloth);

/// Whether stretch is measured along edges, not in triangles.
constexpr bool has_edge_law(Model model) {
    return model == Model::Cubic || model == Model::Linear || model == Model::StvkEdge;
}

/// How an edge is stretched: its length over its rest length.
struct EdgeStretch {
    std::size_t edge; ///< index in the network
    double stretch;
};

/// The stretch of each edge that resists it, sides and diagonals, in the network's order.
/// @param x  positions of the object's vertices or particles, m
std::vector<EdgeStretch> edge_stretches(const EdgeNetwork& network, std::span<const Vec3> x);

/// Means over the edges at each vertex, `count` long; without edges 1 and 0.
struct VertexEdgeMeasures {
    std::vector<float> stretch;
    std::vector<float> tension; ///< the law's force over rest length, N/m
};
VertexEdgeMeasures measure_edges(const EdgeNetwork& network,
                                 const LawShape& shape,
                                 std::span<const Vec3> x,
                                 std::size_t count);

/// Length over rest length of each edge of a solid's network.
std::vector<double> edge_stretches(const World& world, const Solid& solid);

/// Mean stretch of the edges at each particle (1 where there is none), interpolated to the surface
/// vertices that are embedded among the particles, #vertices.
std::vector<double> surface_stretches(const World& world, const Solid& solid);

/// Cells of which any of the tetrahedra at their eight corners, or of the six that carry the
/// surface, has turned inside out or lost its volume.
std::size_t count_inverted_cells(const World& world, const Solid& solid);

/// What a body's surface holds, m^3; an open one is closed by fans about the middles of its rims.
double body_volume(const World& world, const Body& body);

} // namespace weft
