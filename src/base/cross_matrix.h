#pragma once

#include "base/eigen.h"

namespace weft {

/// [a]x: its product with b is the cross product of a and b.
inline Mat3 cross_matrix(const Vec3& a) {
    Mat3 m;
    m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
    return m;
}

} // namespace weft
