#pragma once

#include "geometry/triangle_mesh.h"

#include <array>
#include <span>
#include <vector>

/// Local edits of a triangle mesh that keep its edges right, each with its exact inverse: an edit
/// and its inverse give back every slot bit for bit, corner order and sides of edges included.
///
/// Slots keep their numbers. An edit takes new slots at the end of the arrays; its inverse leaves
/// those slots dead (all entries k_no_index), to be filled by move_triangle and move_edge. Vertices
/// are numbers alone. What an edit writes besides new slots: the triangles it names and their
/// edges.
///
/// Where an edge is cut, flipped or cut off by a merge, it lies opposite to corner 0 of its
/// triangles (asserted), as the edits themselves leave it. Cost of each edit: constant.
namespace weft {

/// The arrays that an edit works on.
struct EditedMesh {
    std::vector<Triangle>& triangles;
    EdgeTopology& topology;
};

/// Corner of triangle t that is opposite to its edge e: 0, 1 or 2.
std::size_t corner_opposite(const EdgeTopology& topology, Index t, Index e);

/// The triangle on the other side of edge e from triangle t; k_no_index on the boundary.
Index triangle_across(const EdgeTopology& topology, Index t, Index e);

bool is_dead(const Triangle& triangle);
bool is_dead(const MeshEdge& edge);

/// Cuts t = (c0, c1, c2) into three about the new vertex p.
///
///               c2            child 0 = (p, c0, c1) in slot t,
///             / | \           child 1 = (p, c1, c2) in slot [0] of what it returns,
///            / 2 1 \          child 2 = (p, c2, c0) in slot [1].
///           /   p   \         Three new edges (p, c0), (p, c1), (p, c2).
///         c0 -- 0 -- c1
std::array<Index, 2> split_triangle(EditedMesh mesh, Index t, Index p);

/// Inverse of split_triangle: children in their order, the first of which becomes the parent.
void merge_triangles(EditedMesh mesh, const std::array<Index, 3>& children);

/// Turns the inner edge e = (a, b) of A = (P, a, b) and B = (Q, b, a) to join P and Q.
///
///          P                 P
///         / \               /|\         A becomes (P, a, Q),
///        a - b     ->      a | b        B becomes (Q, b, P),
///         \ /               \|/         e becomes (Q, P).
///          Q                 Q
void flip_edge(EditedMesh mesh, Index e);

/// Inverse of flip_edge; e lies opposite to corner 1 of both its triangles.
void unflip_edge(EditedMesh mesh, Index e);

/// Slots that a trisection takes. [s] is on side s of the edge; k_no_index beyond a boundary.
struct Trisection {
    std::array<Index, 2> at_first; ///< (v1, P, a) on side 0, (v1, a, Q) on side 1
    std::array<Index, 2> at_last;  ///< (v2, b, P) on side 0, (v2, Q, b) on side 1
};

/// Cuts edge e = (a, b) at the new vertices v1, nearer to a, and v2. Both of its triangles are cut
/// in three.
///
///              P              A = (P, a, b) becomes the middle triangle (P, v1, v2),
///           / / \ \           e becomes the middle edge (v1, v2); on the other side
///         a - v1-v2 - b       B = (Q, b, a) becomes (Q, v2, v1).
///           \ \ / /
///              Q              New edges: (a, v1), (v2, b), and two spokes on each side.
Trisection trisect_edge(EditedMesh mesh, Index e, Index v1, Index v2);

/// Inverse of trisect_edge, of the middle edge.
void join_edge(EditedMesh mesh, Index e);

/// Moves a triangle to the dead slot `to`, and leaves `from` dead. Writes to its edges.
void move_triangle(EditedMesh mesh, Index from, Index to);

/// Moves an edge to the dead slot `to`, and leaves `from` dead.
void move_edge(EditedMesh mesh, Index from, Index to);

/// Names vertex `from` `to` in the triangles given, all that have it, and in their edges.
void rename_vertex(EditedMesh mesh, std::span<const Index> star, Index from, Index to);

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
