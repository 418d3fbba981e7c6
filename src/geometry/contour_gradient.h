#pragma once

#include "base/eigen.h"

#include <optional>
#include <span>

namespace weft {

/// Direction (unit) in which an edge that pierces a face has to move against it so that the curve
/// in which the two surfaces cross grows shorter.
///
/// @param p, q   ends of the edge
/// @param apexes corners opposite to the edge of its one or two triangles
/// @param normal of the face, unit
/// Nothing when the edge lies in the face, or its two triangles pull evenly.
/// Source: Volino and Magnenat-Thalmann 2006, resolving surface collisions through intersection
/// contour minimization: sum over the triangles of R - 2 (E.R)/(E.N) N, R the unit direction of
/// the contour into the triangle.
std::optional<Vec3>
contour_gradient(const Vec3& p, const Vec3& q, std::span<const Vec3> apexes, const Vec3& normal);

} // namespace weft
