#pragma once

#include "base/eigen.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace weft {

/// How fine a triangle is. Even generation 2k: level k, a third as large as level k - 1. Odd 2k +
/// 1: cut off a triangle of generation 2k and not flipped yet; corner 0 is the vertex that was put
/// in (its apex), the edge opposite is its mate edge, the triangle across that its mate.
struct TriangleLevel {
    std::int32_t generation = 0;
    /// Which part of what was cut this slot took, two bits for each odd generation up to its own.
    /// 0: the part that stays in the slot of what was cut.
    std::uint32_t parts = 0;
};

/// Where a vertex was put in.
enum class Insertion : std::int32_t {
    Centre,    ///< the barycentre of a triangle
    EdgeFirst, ///< the third of an edge nearer to the edge's first end
    EdgeLast,  ///< the third nearer to its other end; both always come and go together
};

/// A vertex that refinement put in, with what its removal needs. No entry but `partner` names a
/// vertex that may be renumbered.
struct InsertedVertex {
    /// Rest shape of the triangle that was cut for it: inverse_edges by columns, area. Of a pair on
    /// an edge the first keeps that on side 0 of the edge, the last that on side 1 (zeros: no
    /// triangle).
    std::array<double, 5> parent_rest{};
    std::int32_t generation = 0; ///< odd: of the triangles that it was put in with
    Insertion insertion = Insertion::Centre;
    Index partner = k_no_index; ///< on edges: the other vertex of the pair
    Index anchor = k_no_index;  ///< an imported vertex that it descends from
    Index born = 0;             ///< the adaptation that put it in, as its caller counts
    std::int32_t unused = 0;    ///< no padding: the record is stored byte by byte
};

/// What a cloth knows of its refinement beyond its present mesh. Imported vertices, triangles and
/// edges come first in their arrays and keep their numbers: a slot of theirs always holds them or
/// what became of them, and gets them back bit for bit when all vertices put in are removed.
struct Refinement {
    Index base_vertices = 0; ///< imported; 0: the cloth is not adaptive, and all below is empty
    Index base_triangles = 0;
    Index base_edges = 0;
    std::vector<TriangleLevel> triangles; ///< #triangles
    std::vector<InsertedVertex> vertices; ///< vertex base_vertices + i
    std::vector<std::uint8_t> locked;     ///< #edges: never flipped; cut on both sides at once
    std::vector<std::uint8_t> frozen;     ///< #base_triangles: never cut
    std::vector<Index> pending_flips;     ///< edges whose flip was refused, ascending

    std::vector<Vec3> start; ///< #vertices: where each was, or would have been, at t = 0, m
    Index adaptations = 0;   ///< done so far
    double tolerance = 1.0;  ///< of coarseness; above 1 where the budget of triangles is short

    bool empty() const { return base_vertices == 0; }
    bool is_inserted(Index v) const { return v >= base_vertices; }
    const InsertedVertex& inserted(Index v) const {
        return vertices[static_cast<std::size_t>(v - base_vertices)];
    }
};

static_assert(std::is_trivially_copyable_v<InsertedVertex> && sizeof(InsertedVertex) == 64);
static_assert(std::is_trivially_copyable_v<TriangleLevel> && sizeof(TriangleLevel) == 8);

/// Level of a generation: how many times its triangles are a third of the imported ones. A triangle
/// that waits for its flip counts as what it will be.
inline int level_of(std::int32_t generation) {
    return (generation + 1) / 2;
}

} // namespace weft
