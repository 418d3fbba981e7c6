#pragma once

#include "base/eigen.h"

#include <vector>

namespace weft {

/// How high one place of a triangle stands over another triangle, seen along a direction.
struct ColumnGap {
    Vec3 weights;  ///< of the place on the upper triangle's corners, sum 1
    Vec3 base;     ///< the place under it on the lower triangle, m
    double height; ///< m; negative: the upper one's place is below
};

/// Heights of triangle `upper` over triangle `lower` along the unit vector n where both lie over
/// one another: at corners of either and where their sides cross in that view. Of flat triangles
/// the least and greatest height are among them; `upper` is clear of `lower` in that view when all
/// are positive. Appends to `gaps`.
void column_gaps(const std::array<Vec3, 3>& upper,
                 const std::array<Vec3, 3>& lower,
                 const Vec3& n,
                 std::vector<ColumnGap>& gaps);

} // namespace weft
