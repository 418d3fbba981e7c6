#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

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
