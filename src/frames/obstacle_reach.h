#pragma once

#include "state/obstacle.h"

namespace weft {

/// Far points of all the places that an obstacle takes from t = 0 to `end` (s), in single
/// precision: what a camera needs to know of its motion beforehand. Sampled in time and over the
/// vertices.
std::vector<Vec3f> obstacle_reach(const Obstacle& obstacle, double end, double fps);

} // namespace weft
