#pragma once

#include "state/cloth.h"

#include <functional>

/// Flat sheets with the triangle patterns on which the mechanics is judged.
namespace weft::test {

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

/// A cloth at rest in the sheet's plane, weft along x.
Cloth cloth_of(const Sheet& sheet,
               const FabricParams& fabric = {},
               BendModel bend_model = BendModel::MidEdge);

/// Positions (m) of the sheet's points under a map of the plane into space.
std::vector<Vec3> placed(const Sheet& sheet, const std::function<Vec3(const Vec2&)>& map);

} // namespace weft::test
