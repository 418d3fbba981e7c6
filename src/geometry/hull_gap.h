#pragma once

#include "base/eigen.h"

#include <array>

namespace weft {

/// A lower bound (m) of the distance between a tetrahedron and a triangle: the widest gap along the
/// directions in which two such bodies can be parted (face normals and products of edges); below 0
/// when none parts them, and then they meet. Flat and collapsed tetrahedra are allowed.
/// Source: Gottschalk et al. 1996 (separating axes).
double hull_gap(const std::array<Vec3, 4>& tetrahedron, const std::array<Vec3, 3>& triangle);

} // namespace weft
