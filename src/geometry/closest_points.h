#pragma once

#include "base/eigen.h"

namespace weft {

/// Weights (barycentric, >= 0, sum to 1) of the point of triangle (x0, x1, x2) closest to p.
/// A triangle without area is treated as its longest edge. Source: Ericson 2005, section 5.1.5.
Vec3 closest_weights_on_triangle(const Vec3& p, const Vec3& x0, const Vec3& x1, const Vec3& x2);

/// Weight t in [0, 1] of x1 at the point of segment (x0, x1) closest to p; 0 for a point.
double closest_weight_on_segment(const Vec3& p, const Vec3& x0, const Vec3& x1);

} // namespace weft
