#pragma once

#include "state/refinement.h"
#include "state/world.h"

namespace weft {

/// Gives the vertices of a world the numbers that they have once cloth number `index` has
/// cloth.vertex_count vertices instead of `old_count`: those of later cloths and of bodies move
/// along, and so does all that names a vertex. Values of the cloth itself are left to be set; its
/// pins are taken out, and so is what contact remembers of vertices that are gone.
void renumber_world(World& world,
                    std::size_t index,
                    std::size_t old_count,
                    const ClothChanges& changes);

} // namespace weft
