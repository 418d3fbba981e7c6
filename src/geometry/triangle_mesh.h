#pragma once

#include "base/eigen.h"

#include <span>
#include <vector>

namespace weft {

/// A surface: positions (m) and triangles that index them. Nothing more; what is derived is below.
struct TriangleMesh {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
};

/// One edge of a triangle mesh, its one or two triangles and the vertices opposite to it.
///
///            apex[0]
///            /     \            triangle[0] = (v[0], v[1], apex[0]) in some rotation,
///         v[0] --- v[1]         triangle[1] = (v[1], v[0], apex[1]) in some rotation;
///            \     /            on the boundary triangle[1] = apex[1] = k_no_index.
///            apex[1]
struct MeshEdge {
    std::array<Index, 2> v;
    std::array<Index, 2> triangle;
    std::array<Index, 2> apex;

    bool is_boundary() const { return triangle[1] == k_no_index; }
};

/// All edges of a mesh, and for each triangle its three edges: triangle_edges[t][k] is the edge
/// opposite to corner k. As build_edges makes them, edges are sorted by (triangle[0], corner).
struct EdgeTopology {
    std::vector<MeshEdge> edges;
    std::vector<std::array<Index, 3>> triangle_edges;
};

/// Edges of a mesh. An edge with more than two triangles, or with two that run along it in the same
/// direction, is split: each further triangle gets a boundary edge of its own (find_defects names
/// them).
EdgeTopology build_edges(std::span<const Triangle> triangles);

/// Boundary loops as closed vertex sequences, each starting at its lowest vertex, ordered by it.
std::vector<std::vector<Index>> boundary_loops(const EdgeTopology& topology);

/// Connected part of each triangle, 0-based in the order of first triangles; returns the part
/// count.
int connected_parts(std::span<const Triangle> triangles, std::vector<int>& part_of_triangle);

/// Unit normal of triangle (x0, x1, x2); zero when it has no area.
Vec3 triangle_normal(const Vec3& x0, const Vec3& x1, const Vec3& x2);

/// Area of triangle (x0, x1, x2), m^2.
double triangle_area(const Vec3& x0, const Vec3& x1, const Vec3& x2);

} // namespace weft
