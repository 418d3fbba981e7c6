#pragma once

#include "state/world.h"

namespace weft {

/// Takes cloth that was pinched until it crossed apart by geometry, as at a start that overlaps
/// (collide/untangle.h), where obstacles leave room again: without work done on it, velocities stay
/// as they are. Nothing is changed when it does not come out whole.
/// @return whether no pair crosses any more
bool recover_from_crossings(World& world);

} // namespace weft
