#pragma once

#include "base/eigen.h"

#include <array>
#include <vector>

namespace weft {

/// A lower bound (m) of the distance between a tetrahedron and a triangle: the widest gap along the
/// directions in which two such bodies can be parted (face normals and products of edges); below 0
/// when none parts them, and then they meet. Flat and collapsed tetrahedra are allowed.
/// Source: Gottschalk et al. 1996 (separating axes).
double hull_gap(const std::array<Vec3, 4>& tetrahedron, const std::array<Vec3, 3>& triangle);

/// Height of one place of a triangle over another triangle, seen along a direction.
struct ColumnGap {
    Vec3 weights;  ///< barycentric weights of the place on the upper triangle's corners, sum 1
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
