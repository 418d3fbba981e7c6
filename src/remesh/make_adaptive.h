#pragma once

#include "state/world.h"

namespace weft {

/// Makes the meshes of all cloths that are to be refined adaptive. Of a world at t = 0, as it will
/// start; creases of imported shapes and triangles with an attached vertex are kept.
void make_adaptive(World& world);

} // namespace weft
