#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// The triangles around each vertex of a mesh that changes: a list through the corners, so that
/// pinched vertices and any valence are right, and a triangle comes and goes at the cost of its
/// corners' valence.
class VertexStars {
public:
    VertexStars() = default;
    VertexStars(std::span<const Triangle> triangles, Index vertex_count);

    /// Enters triangle t; vertices and triangles beyond the present ones are made room for.
    void add(Index t, const Triangle& corners);

    /// Takes triangle t out again; corners as it was entered.
    void remove(Index t, const Triangle& corners);

    /// Fills `star` with the triangles that have vertex v, ascending.
    void triangles_of(Index v, std::vector<Index>& star) const;

    bool is_empty(Index v) const;

private:
    std::vector<Index> first_; ///< by vertex: 3 t + k of a corner there, or k_no_index
    std::vector<Index> next_;  ///< by 3 t + k: the next corner at the same vertex
};

} // namespace weft
