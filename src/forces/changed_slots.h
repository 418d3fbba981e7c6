#pragma once

#include "state/cloth.h"
#include "state/cloth_changes.h"

#include <vector>

namespace weft {

/// Which elements that reach beyond their own triangle or edge a change of the mesh makes others,
/// as slots of the cloth as it is now, ascending, each once.

/// Edges that changed or one of whose triangles did: what is taken from the rest shapes of both.
std::vector<Index> changed_hinges(const Cloth& cloth, const ClothChanges& changes);

/// Triangles that changed, or one of whose edges or neighbours did.
std::vector<Index> changed_patches(const Cloth& cloth, const ClothChanges& changes);

} // namespace weft
