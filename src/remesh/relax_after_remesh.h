#pragma once

#include "remesh/changed_patches.h"
#include "remesh/vertex_energy.h"

namespace weft {

/// A cloth after an adaptation, and what its relaxation may do.
struct RelaxationContext {
    const Cloth& cloth;
    const VertexStars& stars;
    BendElements& bends;
    Vec3 gravity;                   ///< m/s^2
    std::span<const char> may_move; ///< #V: 0 stays
    double farthest;                ///< greatest displacement of a vertex, m
    std::vector<Vec3>& x;           ///< #V, m; the relaxation changes it
};

/// Moves the vertices of a patch that has gained energy by an adaptation until the gain is gone,
/// and no further. A flip puts an edge across a fold, or takes one away; shifts by a fraction of
/// the fold's depth undo the strain that this gives the triangles.
///
/// Each vertex moves to where elastic force and weight give it the acceleration that it had before
/// the adaptation; a new vertex takes the mean acceleration of its neighbours. Moving it to where
/// no force is left would also remove the forces of the motion: flags lose a fifth of their energy
/// by that in a second.
///
/// @param shifted  receives the vertices that moved
/// @returns gain that is left, J
double relax_after_remesh(const RelaxationContext& context,
                          const ChangedPatch& patch,
                          std::vector<Index>& shifted);

} // namespace weft
