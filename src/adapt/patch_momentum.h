#pragma once

#include "base/eigen.h"

#include <span>

namespace weft {

/// Mass and motion of some vertices.
struct PatchMomentum {
    double mass = 0.0;           ///< kg
    Vec3 linear = Vec3::Zero();  ///< kg m/s
    Vec3 angular = Vec3::Zero(); ///< about the origin, kg m^2/s
    double kinetic = 0.0;        ///< J

    void add(double m, const Vec3& x, const Vec3& v);
    PatchMomentum& operator+=(const PatchMomentum& other);
};

/// Changes velocities (m/s) of vertices at x (m) with masses m (kg) as little as it takes for their
/// linear and angular momentum to be those of `before`; then lowers what is not a rigid motion
/// until the kinetic energy is no greater than before, as far as that goes: masses that came nearer
/// to the axis of a spin turn faster, or lose angular momentum. Angular momentum along directions
/// in which the vertices have all but no inertia is left as it is.
void restore_momentum(const PatchMomentum& before,
                      std::span<const double> m,
                      std::span<const Vec3> x,
                      std::span<Vec3> v);

} // namespace weft
