#pragma once

#include "geometry/triangle_mesh.h"

#include <array>
#include <span>
#include <vector>

namespace weft {

/// Shares of a triangle's area that belong to its three corners, m^2; they sum to its area exactly.
/// Non-obtuse: the Voronoi regions. Obtuse: half to the obtuse corner, a quarter to the others.
/// Source: Meyer et al. 2003, "Discrete differential-geometry operators", section 3.3.
///
/// @param corners  in the triangle's own plane, m; any orientation; no area gives zeros
std::array<double, 3> mixed_corner_areas(const std::array<Vec2, 3>& corners);
std::array<double, 3> mixed_corner_areas(const Vec3& x0, const Vec3& x1, const Vec3& x2);

/// Mixed Voronoi areas of all vertices, #V long, m^2; their sum is the surface's area.
std::vector<double> mixed_areas(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles);

} // namespace weft
