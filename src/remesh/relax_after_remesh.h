#pragma once

#include "remesh/vertex_energy.h"
#include "state/cloth.h"
#include "state/refinement.h"

#include <span>
#include <vector>

namespace weft {

/// A vertex of an element that an adaptation changed.
struct ChangedVertex {
    Index vertex;                     ///< index in the cloth as it is now
    double area_before = 0.0;         ///< rest area, m^2; 0: it is new
    Vec3 force_change = Vec3::Zero(); ///< change of the elastic force on it, N
};

/// A connected region of elements that one adaptation changed; patches share no vertex.
struct ChangedPatch {
    std::vector<ChangedVertex> vertices; ///< ascending
    double gain = 0.0;                   ///< change of elastic and gravity energy, J
};

/// A cloth and the positions of its vertices.
struct PlacedCloth {
    const Cloth& cloth;
    std::span<const Vec3> x; ///< #V, m
};

/// Finds the patches that an adaptation changed: vertices belong together when a changed element of
/// the membrane or of bending, before or after, joins them.
///
/// @param gravity  m/s^2
std::vector<ChangedPatch> find_changed_patches(const PlacedCloth& before,
                                               const PlacedCloth& after,
                                               const ClothChanges& changes,
                                               const Vec3& gravity);

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
