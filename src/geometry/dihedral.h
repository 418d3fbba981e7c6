#pragma once

#include "base/eigen.h"

namespace weft {

/// Dihedral angle of the edge (x0, x1) between the triangles (x0, x1, x2) and (x1, x0, x3), rad in
/// (-pi, pi]: 0 when flat, negative when the apexes x2, x3 are raised along the normals. Triangles
/// without area count as flat.
double dihedral_angle(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);

/// Its gradient by the four points, 1/m; zero when a triangle has no area. Moves with a rigid
/// motion: the gradients have no sum and no torque.
/// Source: Bridson et al. 2003; the form of Tamstorf and Grinspun 2013.
std::array<Vec3, 4>
dihedral_gradient(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);

} // namespace weft
