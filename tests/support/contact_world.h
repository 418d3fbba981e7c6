#pragma once

#include "collide/contact_solver.h"
#include "support/objects.h"

namespace weft::test {

/// One substep under gravity of a world without pins in which contact alone acts, by its impulses:
/// nothing is solved for. Returns what contact did.
ContactReport contact_step(World& world, ContactSolver& solver, double dt);

} // namespace weft::test
