#pragma once

#include "geometry/triangle_mesh.h"

#include <array>
#include <vector>

/// Flat sheets with the triangle patterns on which the mechanics is judged.
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

struct Sheet {
    std::vector<Vec2> points; ///< m
    std::vector<Triangle> triangles;
};

/// nx by ny cells of a width × height rectangle at the origin, each cut along the same diagonal.
Sheet one_diagonal_sheet(int nx, int ny, double width, double height);

/// The same with diagonals alternating like a chess board.
Sheet union_jack_sheet(int nx, int ny, double width, double height);

/// Rows of equilateral triangles with side a; nx triangles' bases along x, ny rows.
Sheet equilateral_sheet(int nx, int ny, double side);

/// One-diagonal grid with inner points moved at random by up to `jitter` cells, then made Delaunay.
Sheet irregular_sheet(int nx, int ny, double width, double height, double jitter, unsigned seed);

/// The three patterns on which experiments are repeated.
enum class Pattern { OneDiagonal, UnionJack, Irregular };
inline constexpr std::array k_patterns{Pattern::OneDiagonal, Pattern::UnionJack,
                                       Pattern::Irregular};
const char* name_of(Pattern pattern);

/// A rectangle in one of them; irregular: inner points moved by up to a quarter of a cell.
Sheet make_sheet(Pattern pattern, int nx, int ny, double width, double height);

} // namespace weft
