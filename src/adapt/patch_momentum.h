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

/// Gives a patch of vertices at x (m) with masses m (kg) the linear and angular momentum `before`,
/// by the least change of their velocities v (m/s).
///
/// Where the patch has more kinetic energy than before after that, the velocities that differ from
/// its rigid motion are scaled down until it has not, by a fiftieth at most. A gain that is left
/// comes from masses that moved nearer to the axis of a spin; it is lost again when they move back.
/// Directions about which the vertices have next to no inertia keep their angular momentum.
void restore_momentum(const PatchMomentum& before,
                      std::span<const double> m,
                      std::span<const Vec3> x,
                      std::span<Vec3> v);

} // namespace weft
