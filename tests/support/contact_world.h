#pragma once

#include "collide/contact.h"
#include "support/objects.h"

namespace weft::test {

/// What step() lets act besides contact.
struct StepForces {
    Vec3 gravity{0.0, -9.81, 0.0}; ///< m/s^2
    double spring = 0.0;           ///< N/m along each edge, explicit, with its critical damping / 4
};

/// One explicit substep of a world without pins: forces, contact, positions. Returns what contact
/// did.
ContactReport step(World& world, ContactSolver& solver, double dt, const StepForces& forces = {});

} // namespace weft::test
