#pragma once

#include "base/eigen.h"

#include <algorithm>
#include <cmath>

namespace weft {

/// A convex polygon that is left of a triangle cut at the faces of a cube.
struct PiecePolygon {
    std::array<Vec3, 9> corners;
    std::size_t count = 0;
};

/// The part of a polygon between low and high along an axis; what lies in a bound is kept.
PiecePolygon cut_to_slab(const PiecePolygon& polygon, int axis, double low, double high);

/// Cuts a triangle at the planes of the unit lattice and calls f(cell, piece) for each cell, of
/// `size` cells from 0 on, that holds a piece of it; what lies outside goes to the outermost ones.
/// A piece within a plane goes to one of the cells beside it.
template <typename F>
void for_each_piece(const std::array<Vec3, 3>& triangle,
                    const std::array<int, 3>& size,
                    const F& f) {
    const auto for_each_slab = [&](const PiecePolygon& polygon, int axis, const auto& go_on) {
        double least = polygon.corners[0][axis];
        double greatest = least;
        for (std::size_t k = 1; k < polygon.count; ++k) {
            least = std::min(least, polygon.corners[k][axis]);
            greatest = std::max(greatest, polygon.corners[k][axis]);
        }
        const int most = size[static_cast<std::size_t>(axis)] - 1;
        const int first = std::clamp(static_cast<int>(std::floor(least)), 0, most);
        const int last = std::clamp(static_cast<int>(std::ceil(greatest)) - 1, first, most);
        for (int i = first; i <= last; ++i) {
            const PiecePolygon part = first == last
                                          ? polygon
                                          : cut_to_slab(polygon, axis, i == first ? least : i,
                                                        i == last ? greatest : i + 1);
            if (part.count > 0) {
                go_on(i, part);
            }
        }
    };
    PiecePolygon whole;
    std::copy(triangle.begin(), triangle.end(), whole.corners.begin());
    whole.count = 3;
    for_each_slab(whole, 0, [&](int x, const PiecePolygon& column) {
        for_each_slab(column, 1, [&](int y, const PiecePolygon& row) {
            for_each_slab(row, 2, [&](int z, const PiecePolygon& piece) {
                f(std::array<int, 3>{x, y, z}, piece);
            });
        });
    });
}

} // namespace weft
