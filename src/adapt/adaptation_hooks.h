#pragma once

#include "base/eigen.h"

#include <functional>
#include <limits>
#include <vector>

namespace weft {

/// Where a vertex stands among its parents: x = sum of weights[k] x[parents[k]]. Three thirds of a
/// triangle's corners, or 2/3 and 1/3 of an edge's ends; then parents[2] = k_no_index, weight 0.
struct VertexParents {
    Index vertex;
    std::array<Index, 3> parents;
    std::array<double, 3> weights;
};

/// An edge between two triangles gives way to the edge between their apexes: (P, a, b) and
/// (Q, b, a) become (P, a, Q) and (Q, b, P). The surface sweeps the tetrahedron a b P Q.
struct EdgeFlip {
    std::array<Index, 2> edge; ///< a, b
    std::array<Index, 2> apex; ///< P, Q
};

/// The edits that remove a vertex, or the pair on an edge, in this order.
struct Removal {
    std::vector<EdgeFlip> flips;         ///< back to what was; `edge` is the one that goes
    std::vector<VertexParents> vertices; ///< these move to where their parents' mean is, and vanish
    std::vector<Triangle> merged;        ///< and these triangles are left
};

/// Calls from an adaptation to its caller, which may refuse edits. Empty functions allow all, or do
/// nothing. They must not edit the cloth. Vertices are the cloth's own, as they are at the time of
/// the call.
struct AdaptationHooks {
    std::function<bool(const EdgeFlip&)> may_flip;    ///< false: it waits for retry_flips()
    std::function<bool(const Removal&)> may_remove;   ///< false: nothing of it is done
    std::function<void(const VertexParents&)> insert; ///< is in the mesh now, on the old surface
    std::function<void(const VertexParents&)> remove; ///< before anything of a removal is done
    std::function<void(Index from, Index to)> move;   ///< in finish(); what stood in `to` is gone
};

/// 3^15 triangles for one; the record of parts has two bits for each level.
inline constexpr Index k_most_levels = 15;

/// Bounds of an adaptation.
struct AdaptationLimits {
    Index max_level = 0; ///< no triangle becomes finer, 0..k_most_levels
    Index max_triangles = std::numeric_limits<Index>::max(); ///< refining stops before more
    Index adaptation = 0; ///< number of this adaptation: `born` of the vertices that it puts in
};

} // namespace weft
