#pragma once

#include "geometry/triangle_mesh.h"

namespace weft {

/// Sphere about the origin: an icosahedron split until chords stray from it by less than 0.1 % of
/// the radius (5120 triangles). Vertices lie on the sphere.
TriangleMesh sphere_mesh(double radius);

/// Box about the origin with the given edge lengths; 12 triangles.
TriangleMesh box_mesh(const Vec3& size);

/// Rectangle in x-z about the origin, facing +y, size.x() by size.z(); 2 triangles.
TriangleMesh plane_mesh(const Vec3& size);

/// Flat sheet in x-z about the origin, facing +y, its diagonals alternating (union jack) so that no
/// direction is stiffer than another. Vertex j * (cells[0] + 1) + i lies at the i-th x and j-th z.
TriangleMesh grid_mesh(const Vec2& size, const std::array<int, 2>& cells);

} // namespace weft
