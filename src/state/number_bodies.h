#pragma once

#include "state/world.h"

namespace weft {

/// Numbers the vertices of all bodies anew: from those of the last cloth on, in the world's order.
/// For when cloths have gained or lost vertices.
void number_bodies(World& world);

} // namespace weft
