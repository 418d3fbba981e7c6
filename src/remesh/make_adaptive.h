#pragma once

#include "state/world.h"

namespace weft {

/// Makes the meshes of all cloths that are to be refined adaptive. The world is the one that the
/// run starts from, at t = 0; creases of imported shapes and triangles with an attached vertex are
/// kept.
void make_adaptive(World& world);

} // namespace weft
