#include "collide/contact.h"

#include <cmath>

namespace weft {

namespace {

/// Fraction of the barrier's width after which the law goes on along its tangent, there 25 times as
/// stiff as at first. Nearer to 1: heavier loads stay above the floor, but the matrix is worse
/// conditioned.
constexpr double k_tangent_from = 0.8;

} // namespace

double NormalLaw::force(double approach) const {
    if (approach <= 0.0) {
        return 0.0;
    }
    const double last = k_tangent_from * barrier_width;
    const double s = std::min(approach, last);
    return stiffness * s / (1.0 - s / barrier_width) + tangent(last) * (approach - s);
}

double NormalLaw::tangent(double approach) const {
    if (approach <= 0.0) {
        return 0.0;
    }
    const double left = 1.0 - std::min(approach / barrier_width, k_tangent_from);
    return stiffness / (left * left);
}

double NormalLaw::energy(double approach) const {
    if (approach <= 0.0) {
        return 0.0;
    }
    const double last = k_tangent_from * barrier_width;
    const double s = std::min(approach, last);
    const double beyond = approach - s;
    return stiffness * barrier_width * (-s - barrier_width * std::log1p(-s / barrier_width)) +
           beyond * (force(last) + 0.5 * tangent(last) * beyond);
}

} // namespace weft
