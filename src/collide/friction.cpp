#include "collide/friction.h"

#include "collide/contact.h"
#include "collide/contact_surface.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

const FrictionPair*
find_pair(std::span<const FrictionPair> table, const std::string& a, const std::string& b) {
    const std::array<std::string, 2> names{a, b};
    const auto found = std::find_if(table.begin(), table.end(), [&](const FrictionPair& pair) {
        return std::is_permutation(names.begin(), names.end(), pair.between.begin());
    });
    return found == table.end() ? nullptr : &*found;
}

} // namespace

FrictionCoefficients friction_between(const ContactObject& a,
                                      const ContactObject& b,
                                      std::span<const FrictionPair> table) {
    if (const FrictionPair* pair = find_pair(table, a.name, b.name)) {
        return {pair->friction, pair->static_friction.value_or(pair->friction)};
    }
    return {std::sqrt(a.friction * b.friction), std::sqrt(a.static_friction * b.static_friction)};
}

double friction_limit(const Contact& contact, double normal_force) {
    return (contact.slides ? contact.friction : contact.static_friction) * normal_force;
}

Vec3 limit_friction_impulse(const Vec3& impulse, double limit) {
    const double wanted = impulse.norm();
    return wanted > limit ? Vec3(limit / wanted * impulse) : impulse;
}

Vec3 FrictionLaw::force(const Vec3& displacement) const {
    const double elastic = stiffness * displacement.norm();
    return elastic > limit ? Vec3(-limit * stiffness / elastic * displacement)
                           : Vec3(-stiffness * displacement);
}

Mat3 FrictionLaw::tangent(const Vec3& displacement) const {
    return damped_tangent(displacement, 0.0);
}

Mat3 FrictionLaw::damped_tangent(const Vec3& displacement, double damping) const {
    const double length = displacement.norm();
    if (stiffness * length <= limit) {
        return stiffness * Mat3::Identity();
    }
    const Vec3 along = displacement / length;
    return limit / length * (Mat3::Identity() - (1.0 - damping) * along * along.transpose());
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
