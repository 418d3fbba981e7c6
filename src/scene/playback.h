#pragma once

#include "scene/params.h"

namespace weft {

/// Time inside an animation of `duration` (s) at scene time t (s): (t - start) * speed, its first
/// pose before, and behind its end the last pose or, looped, from the first again.
double time_in_animation(const AnimationParams& params, double duration, double t);

} // namespace weft
