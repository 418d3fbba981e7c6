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
/// linear and angular momentum to be those of `before`; then takes what energy they have gained off
/// the motion that is not a rigid one, by a fiftieth of its velocities at most. What is left of
/// the gain belongs to masses that came nearer to the axis of a spin, and is lost when they go
/// back. Angular momentum along directions in which the vertices have all but no inertia is left as
/// it is.
void restore_momentum(const PatchMomentum& before,
                      std::span<const double> m,
                      std::span<const Vec3> x,
                      std::span<Vec3> v);

} // namespace weft
