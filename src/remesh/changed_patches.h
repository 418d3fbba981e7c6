#pragma once

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

} // namespace weft
