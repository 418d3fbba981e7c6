#pragma once

#include "state/world.h"

namespace weft {

/// How stiff a spring of contact is at each vertex (N/m, by World vertex): as the material itself,
/// so that the matrix is no worse conditioned; where bodies may be loaded by more than their
/// material is stiff, as the load asks for. Particles have none: what they carry touches.
std::vector<double> contact_stiffness(const World& world);

} // namespace weft
