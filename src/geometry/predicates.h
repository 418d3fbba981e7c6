#pragma once

#include "base/eigen.h"

namespace weft {

/// Side of d of the plane through a, b, c: > 0 when a, b, c appear counter-clockwise seen from d's
/// opposite side (d below, as Shewchuk), < 0 above, 0 exactly on it. The sign is exact for all
/// finite doubles whose products neither overflow nor underflow.
/// Source: Shewchuk 1997, adaptive precision floating-point arithmetic (static filter, then exact).
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

} // namespace weft
