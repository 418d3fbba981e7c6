#pragma once

#include "step/implicit_step.h"

namespace weft {

/// Which vertices the pins hold during a substep that ends at `end_time` (s), and where they take
/// them.
void find_held(const World& world, double end_time, HeldVertices& held);

} // namespace weft
