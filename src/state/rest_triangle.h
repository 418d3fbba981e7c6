#pragma once

#include "base/eigen.h"

namespace weft {

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

} // namespace weft
