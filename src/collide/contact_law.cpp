#include "collide/contact_law.h"

#include <cmath>

namespace weft {

namespace {

/// Share of the room after which the law goes on along its tangent, there 25 times as stiff as at
/// first. Nearer to 1: heavier loads stay above the floor, but the matrix is worse conditioned.
constexpr double k_tangent_from = 0.8;

} // namespace

double NormalLaw::force(double approach) const {
    if (approach <= 0.0) {
        return 0.0;
    }
    const double last = k_tangent_from * room;
    const double s = std::min(approach, last);
    return stiffness * s / (1.0 - s / room) + tangent(last) * (approach - s);
}

double NormalLaw::tangent(double approach) const {
    if (approach <= 0.0) {
        return 0.0;
    }
    const double left = 1.0 - std::min(approach / room, k_tangent_from);
    return stiffness / (left * left);
}

double NormalLaw::energy(double approach) const {
    if (approach <= 0.0) {
        return 0.0;
    }
    const double last = k_tangent_from * room;
    const double s = std::min(approach, last);
    const double beyond = approach - s;
    return stiffness * room * (-s - room * std::log1p(-s / room)) +
           beyond * (force(last) + 0.5 * tangent(last) * beyond);
}

Vec3 FrictionLaw::force(const Vec3& displacement) const {
    const double elastic = stiffness * displacement.norm();
    return elastic > limit ? Vec3(-limit * stiffness / elastic * displacement)
                           : Vec3(-stiffness * displacement);
}

Mat3 FrictionLaw::tangent(const Vec3& displacement) const {
    return damped_tangent(displacement, 0.0);
}

Mat3 FrictionLaw::damped_tangent(const Vec3& displacement, double caution) const {
    const double length = displacement.norm();
    if (stiffness * length <= limit) {
        return stiffness * Mat3::Identity();
    }
    const Vec3 along = displacement / length;
    return limit / length * (Mat3::Identity() - (1.0 - caution) * along * along.transpose());
}

double FrictionLaw::energy(const Vec3& displacement) const {
    const double length = displacement.norm();
    const double elastic = std::min(length, limit / stiffness);
    return 0.5 * stiffness * elastic * elastic + limit * (length - elastic);
}

Vec3 FrictionLaw::kept(const Vec3& displacement) const {
    return slides(displacement) ? Vec3(limit / (stiffness * displacement.norm()) * displacement)
                                : displacement;
}

} // namespace weft
