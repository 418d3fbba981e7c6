#pragma once

#include "state/cloth.h"
#include "state/cloth_changes.h"

#include <span>
#include <vector>

namespace weft {

/// A vertex at which an adaptation changed something.
struct ChangedVertex {
    Index vertex;                     ///< of the cloth as it is now
    double area_before = 0.0;         ///< rest area, m^2; 0: it is new
    Vec3 force_change = Vec3::Zero(); ///< of the elastic forces on it, by the change, N
};

/// One place that an adaptation changed, apart from all else that it changed.
struct ChangedPatch {
    std::vector<ChangedVertex> vertices; ///< ascending
    double gain = 0.0;                   ///< of elastic and gravity energy, J
};

/// A cloth and where it stands.
struct PlacedCloth {
    const Cloth& cloth;
    std::span<const Vec3> x; ///< #V, m
};

/// The places that an adaptation changed: connected by elements of the membrane and of bending that
/// are others now.
///
/// @param gravity  m/s^2
std::vector<ChangedPatch> find_changed_patches(const PlacedCloth& before,
                                               const PlacedCloth& after,
                                               const ClothChanges& changes,
                                               const Vec3& gravity);

} // namespace weft
