#pragma once

#include "base/eigen.h"
#include "geometry/triangle_mesh.h"

#include <array>
#include <span>
#include <vector>

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

/// Mixed Voronoi areas of a triangle's three corners, m^2; they sum to the triangle's area exactly.
/// Non-obtuse: the Voronoi regions. Obtuse: half to the obtuse corner, a quarter to the others.
/// Source: Meyer et al. 2003, "Discrete differential-geometry operators", section 3.3.
///
/// @param corners  in the triangle's own plane, m; any orientation; no area gives zeros
std::array<double, 3> mixed_corner_areas(const std::array<Vec2, 3>& corners);
std::array<double, 3> mixed_corner_areas(const Vec3& x0, const Vec3& x1, const Vec3& x2);

/// Mixed Voronoi areas of all vertices, #V long, m^2; their sum is the surface's area.
std::vector<double> mixed_areas(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles);

/// Mean curvature normal of each vertex, #V long, 1/m: 1/(2 A) sum (cot a + cot b)(x_i - x_j) with
/// A the mixed area; of length 2 H for an inner vertex. Boundary vertices contain the boundary's
/// own bending within the surface and are no curvature. Source: Meyer et al. 2003, equation 8.
std::vector<Vec3> mean_curvature_normals(std::span<const Vec3> positions,
                                         std::span<const Triangle> triangles);

/// Mean curvature |H| of each vertex, #V long, 1/m: half the length of the normal above; 1/R on a
/// sphere, 1/(2R) on a cylinder. On the boundary half the greatest curvature 2 theta / (h0 + h1)
/// across the inner edges whose two triangles touch the vertex, h their heights over the edge;
/// a corner with a single triangle takes the greater value of its two neighbours.
std::vector<double> mean_curvatures(std::span<const Vec3> positions,
                                    std::span<const Triangle> triangles,
                                    const EdgeTopology& topology);

} // namespace weft
