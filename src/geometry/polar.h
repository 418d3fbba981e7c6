#pragma once

#include "base/eigen.h"

namespace weft {

/// F = R S of a 3×2 gradient: R has orthonormal columns, S is symmetric and has no negative
/// eigenvalue.
struct PolarFactor {
    Mat32 R;
    Vec3 normal;          ///< unit, R.col(0) x R.col(1)
    double s11, s12, s22; ///< S
    double determinant;   ///< det S: current area over rest area, >= 0
    double trace() const { return s11 + s22; }
};

/// Polar factor of F, exact in closed form, without division by a small singular value: also for a
/// triangle that has collapsed onto a line (any normal of that line is taken) or a point (R is then
/// the first two axes).
///
/// Source: R = (F + cof F) / tr S, the 2-D polar factor of Shoemake and Duff 1992 in the plane of
/// F.
PolarFactor polar_decompose(const Mat32& F);

/// Singular values of F, greatest first: the principal stretches.
Vec2 principal_stretches(const Mat32& F);

} // namespace weft
