#pragma once

#include "forces/strain.h"
#include "state/world.h"

namespace weft {

/// How each triangle of a cloth is strained, #T long: what statistics and pictures show.
std::vector<StrainMeasures> measure_triangles(const World& world, const Cloth& cloth);

} // namespace weft
