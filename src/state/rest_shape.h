#pragma once

#include "base/eigen.h"

#include <span>
#include <vector>

namespace weft {

struct Cloth;

/// Rest shape of one triangle in its own plane. Axis 0 is weft, axis 1 is warp (grain applied).
struct RestTriangle {
    Mat2 inverse_edges; ///< Dm^-1 with Dm = [m1 - m0, m2 - m0], 1/m
    double area;        ///< m^2, > 0
};

/// Rest length (m) of the edge opposite to corner `k` of a rest triangle.
double rest_edge_length(const RestTriangle& rest, int k);

/// Rest positions of the three corners in the triangle's own plane: 0, m1 - m0, m2 - m0.
std::array<Vec2, 3> rest_corners(const RestTriangle& rest);

/// Least angle of a rest triangle, rad, in (0, pi / 3].
double least_angle(const RestTriangle& rest);

/// Fills cloth.rest and cloth.material_positions from the placed mesh (rest = mesh: each triangle
/// laid flat as it is; docs/methods.md 1.6) or from its uv (rest = uv: panels in metres).
///
/// Weft follows u and warp follows v where the mesh has uv; else warp follows the mesh's y axis
/// laid onto each triangle (z where the triangle is level). `grain_deg` turns both.
///
/// @param positions  #V, rest positions as placed in the world, m
/// @param corner_uv  #T corner uvs, or empty
/// Throws Error (BadInput) naming the cloth and the triangle when a rest triangle has no area.
void build_rest_shape(Cloth& cloth,
                      std::span<const Vec3> positions,
                      std::span<const std::array<Vec2, 3>> corner_uv);

/// Mixed Voronoi areas of the rest shape at the vertices (Meyer et al. 2003), #vertices, m^2.
std::vector<double> mixed_rest_areas(const Cloth& cloth);

/// Total area of the rest shape, m^2.
double rest_area(const Cloth& cloth);

} // namespace weft
