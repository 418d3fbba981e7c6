#include "adapt/make_refinement.h"

#include "adapt/rest_split.h"
#include "geometry/mesh_edit.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace weft {

namespace {

bool is_seam(const Cloth& cloth, Index e) {
    constexpr double k_same_grain = k_same_grain_deg * std::numbers::pi / 180.0;
    const auto [A, B] = cloth.topology.edges[at(e)].triangle;
    const std::size_t in_A = corner_opposite(cloth.topology, A, e);
    const std::size_t in_B = corner_opposite(cloth.topology, B, e);
    const RestTriangle& first = cloth.rest[at(A)];
    const RestTriangle& second = cloth.rest[at(B)];
    const double length = rest_edge_length(first, static_cast<int>(in_A));
    const double other = rest_edge_length(second, static_cast<int>(in_B));
    return std::abs(length - other) > k_same_length * std::max(length, other) ||
           std::abs(frame_turn(first, in_A, second, in_B)) > k_same_grain;
}

} // namespace

void make_refinement(Cloth& cloth) {
    assert(cloth.rest.size() == cloth.triangles.size());
    Refinement& refinement = cloth.refinement;
    refinement = {};
    refinement.base_vertices = cloth.vertex_count;
    refinement.base_triangles = static_cast<Index>(cloth.triangles.size());
    refinement.base_edges = static_cast<Index>(cloth.topology.edges.size());
    refinement.triangles.resize(cloth.triangles.size());
    refinement.frozen.resize(cloth.triangles.size(), 0);
    refinement.locked.resize(cloth.topology.edges.size(), 0);
    for (Index e = 0; e < refinement.base_edges; ++e) {
        refinement.locked[at(e)] = !cloth.topology.edges[at(e)].is_boundary() && is_seam(cloth, e);
    }
}

} // namespace weft
