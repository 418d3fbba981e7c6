#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/params.h"

#include <string>
#include <vector>

namespace weft {

/// Rest shape of one triangle in its own plane. Axis 0 is weft, axis 1 is warp (grain applied).
struct RestTriangle {
    Mat2 inverse_edges; ///< Dm^-1 with Dm = [m1 - m0, m2 - m0], 1/m
    double area;        ///< m^2, > 0
};

/// One cloth: its topology and rest shape. Positions and velocities stand in World; vertex i here
/// is World vertex first_vertex + i, and all indices below are of this cloth alone.
struct Cloth {
    std::string name;
    ClothParams params;
    Index first_vertex = 0;
    Index vertex_count = 0;
    std::vector<Triangle> triangles;
    EdgeTopology topology;
    std::vector<RestTriangle> rest; ///< #triangles
    std::vector<Vec2>
        material_positions;         ///< #vertices, u, m: for output (a seam vertex has its first)
    std::vector<double> rest_areas; ///< #vertices, mixed Voronoi area of the rest shape, m^2
};

/// Rest length (m) of the edge opposite to corner `k` of a rest triangle.
double rest_edge_length(const RestTriangle& rest, int k);

/// Rest positions of the three corners in the triangle's own plane: 0, m1 - m0, m2 - m0.
std::array<Vec2, 3> rest_corners(const RestTriangle& rest);

} // namespace weft
