#pragma once

#include "base/eigen.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace weft {

/// The refinement state of a triangle. A triangle of even generation 2k has level k and a third of
/// the area of level k - 1. One of odd generation 2k + 1 was cut off a triangle of generation 2k
/// and is not flipped yet: corner 0 is the inserted vertex (its apex), the edge opposite is its
/// mate edge, and the triangle across that edge its mate.
struct TriangleLevel {
    std::int32_t generation = 0;
    /// Which part of the cut triangle this slot took, two bits for each odd generation up to its
    /// own. Part 0 stays in the slot of the cut triangle.
    std::uint32_t parts = 0;
};

/// Where refinement inserted a vertex.
enum class Insertion : std::int32_t {
    Centre,    ///< the barycentre of a triangle
    EdgeFirst, ///< the third of an edge nearer to the edge's first end
    EdgeLast,  ///< the third nearer to its other end; both always come and go together
};

/// A vertex that refinement inserted, with the data that its removal needs. Only `partner` names a
/// vertex that may be renumbered. Checkpoints store it byte by byte; `unused` is where the compiler
/// would pad.
struct InsertedVertex {
    /// Rest shape of the triangle that was cut for it: inverse_edges by columns, area. Of a pair on
    /// an edge the first keeps that on side 0 of the edge, the last that on side 1 (zeros: no
    /// triangle).
    std::array<double, 5> parent_rest{};
    std::int32_t generation = 0; ///< odd: generation of the triangles that it was inserted with
    Insertion insertion = Insertion::Centre;
    Index partner = k_no_index; ///< the other vertex of a pair on an edge
    Index anchor = k_no_index;  ///< an imported vertex that it descends from
    Index born = 0;             ///< number of the adaptation that inserted it
    std::int32_t unused = 0;
};

/// The refinement history of a cloth's mesh. Imported vertices, triangles and edges come first in
/// their arrays and keep their numbers: such a slot always holds the imported element or what it
/// was cut into, and gets it back bit for bit when all inserted vertices are removed.
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
    double tolerance = 1.0;  ///< bound on coarseness; above 1 when the budget of triangles is short

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

/// What an adaptation changed in a cloth: the slots of its arrays whose content differs, ascending,
/// each once, counted after the adaptation. Slots at or beyond the present sizes are gone.
struct ClothChanges {
    /// A vertex that is new or in another slot than before. All indices are the cloth's own.
    struct Vertex {
        Index slot;
        Index from; ///< slot before the adaptation; k_no_index: it is new
    };
    std::vector<Vertex> vertices;
    std::vector<Index> masses;    ///< vertices whose rest area changed, including those above
    std::vector<Index> triangles; ///< triangles whose rest shape or corners changed
    std::vector<Index> edges;     ///< edges whose ends, triangles or apexes changed

    bool empty() const { return triangles.empty() && edges.empty() && vertices.empty(); }
};

} // namespace weft
