#pragma once

#include "remesh/changed_patches.h"
#include "remesh/vertex_energy.h"

namespace weft {

/// A cloth after an adaptation, as its vertices give way to what that did to it.
struct YieldingCloth {
    const Cloth& cloth;
    const VertexStars& stars;
    BendElements& bends;
    Vec3 gravity;                   ///< m/s^2
    std::span<const char> may_move; ///< #V: others stay
    double farthest;                ///< that a vertex may go, m
    std::vector<Vec3>& x;           ///< #V, m: shifted
};

/// Lets a patch that has gained energy by an adaptation give way, vertex by vertex, until the gain
/// is gone, and no further. A flip puts an edge across a fold, or takes one away: what the
/// triangles are strained by that is undone by shifts of a fraction of the fold's depth.
///
/// A vertex goes to where it is accelerated by elastic forces and weight as it was before the
/// adaptation, a new one as the vertices around it were. Going to where no force is left would take
/// the motion's own forces away: flags lose a fifth of their energy by that in a second.
///
/// @param shifted  vertices that moved are appended
/// @returns gain that is left, J
double
absorb_gain(const YieldingCloth& yielding, const ChangedPatch& patch, std::vector<Index>& shifted);

} // namespace weft
