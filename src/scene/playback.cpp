#include "scene/playback.h"

#include <algorithm>
#include <cmath>

namespace weft {

double time_in_animation(const AnimationParams& params, double duration, double t) {
    const double inside = std::max(0.0, (t - params.start) * params.speed);
    if (params.end == AnimationEnd::Hold || duration <= 0.0) {
        return std::min(inside, duration);
    }
    return std::fmod(inside, duration);
}

} // namespace weft
