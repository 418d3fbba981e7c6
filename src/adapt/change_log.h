#pragma once

#include "state/cloth.h"
#include "state/refinement.h"
#include "state/world.h"

#include <vector>

namespace weft {

/// Keeps the triangles and edges of a cloth as they were before an adaptation wrote to them.
class ChangeLog {
public:
    /// Forgets all, at the cost of what was written since the last time.
    void begin(const Cloth& cloth);

    /// Triangle t and its edges are about to be written to.
    void touch_triangle(const Cloth& cloth, Index t);

    /// Edge e is about to be written to.
    void touch_edge(const Cloth& cloth, Index e);

    /// A vertex was moved to another slot; each slot is moved from, and to, once an adaptation.
    void move_vertex(Index from, Index to);

    /// The slots whose content differs now. `masses` is left to the caller.
    ClothChanges changes(const Cloth& cloth) const;

    /// Vertices of the triangles written to, ascending. Those that lost a triangle are among them:
    /// an edit leaves none of its vertices without a triangle.
    std::vector<Index> touched_vertices(const Cloth& cloth) const;

private:
    struct OldTriangle {
        Index slot;
        Triangle corners;
        RestTriangle rest;
    };
    struct OldEdge {
        Index slot;
        MeshEdge edge;
    };

    Index vertex_count_ = 0, triangle_count_ = 0, edge_count_ = 0; ///< at begin
    std::vector<OldTriangle> triangles_;
    std::vector<OldEdge> edges_;
    std::vector<char> is_triangle_touched_, is_edge_touched_;
    std::vector<ClothChanges::Vertex> moved_;
};

/// Gives the vertices of a world the numbers that they have once cloth number `index` has
/// cloth.vertex_count vertices instead of `old_count`: those of later cloths and of bodies move
/// along, and so does all that names a vertex. Values of the cloth itself are left to be set; its
/// pins are taken out, and so is what contact remembers of vertices that are gone.
void renumber_world(World& world,
                    std::size_t index,
                    std::size_t old_count,
                    const ClothChanges& changes);

} // namespace weft
