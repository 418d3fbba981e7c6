#include "geometry/lattice_raster.h"

#include "base/parallel.h"
#include "geometry/winding_number.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace weft {

namespace {

/// A convex polygon that is left of a triangle cut at the faces of a cube.
struct PiecePolygon {
    std::array<Vec3, 9> corners;
    std::size_t count = 0;
};

/// The part where sign * (x[axis] - bound) >= 0, by Sutherland and Hodgman 1974.
PiecePolygon cut(const PiecePolygon& polygon, int axis, double bound, double sign) {
    PiecePolygon part;
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const Vec3& a = polygon.corners[k];
        const Vec3& b = polygon.corners[(k + 1) % polygon.count];
        const double at_a = sign * (a[axis] - bound);
        const double at_b = sign * (b[axis] - bound);
        if (at_a >= 0.0) {
            assert(part.count < part.corners.size());
            part.corners[part.count++] = a;
        }
        if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) {
            assert(part.count < part.corners.size());
            Vec3 between = a + at_a / (at_a - at_b) * (b - a);
            between[axis] = bound;
            part.corners[part.count++] = between;
        }
    }
    return part;
}

/// The part of a polygon between low and high along an axis; what lies in a bound is kept.
PiecePolygon cut_to_slab(const PiecePolygon& polygon, int axis, double low, double high) {
    const PiecePolygon above = cut(polygon, axis, low, 1.0);
    return cut(above, axis, high, -1.0);
}

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
        const int most = size[at(axis)] - 1;
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

/// A piece nearer to a face of a fine cell than this lies in the face, in edges of fine cells:
/// beyond rounding of the largest lattices. Larger: vertices stand further outside their cells.
constexpr double k_in_face = 1e-10;

/// Sums over the pieces of triangles in the fine cells of one block.
struct PieceSums {
    std::array<double, 64> areas{};   ///< seen from above, negative of those that face down
    std::array<double, 64> heights{}; ///< the same times their height over the fine cell's floor
};

/// Puts the pieces of a surface into the cells where they lie.
class PieceCollector {
public:
    PieceCollector(LatticeRaster& raster, std::vector<PieceSums>& sums)
        : raster_(raster), sums_(sums) {}

    void add(const std::array<int, 3>& fine, const PiecePolygon& piece) {
        const Index block = block_of(fine);
        const int i = fine[0] % k_fine + k_fine * (fine[1] % k_fine + k_fine * (fine[2] % k_fine));
        const auto slot = at(i);
        const Vec2 sums = area_and_height(piece, fine[2]);
        sums_[at(block)].areas[slot] += sums[0];
        sums_[at(block)].heights[slot] += sums[1];
        if (lies_within(piece, fine)) {
            raster_.blocks[at(block)].touched |= std::uint64_t{1} << slot;
        }
    }

private:
    Index block_of(const std::array<int, 3>& fine) {
        const auto& size = raster_.lattice.size;
        const int x = fine[0] / k_fine;
        const int y = fine[1] / k_fine;
        const int z = fine[2] / k_fine;
        Index& block = raster_.cells[at(x) + at(size[0]) * (at(y) + at(size[1]) * at(z))];
        if (block < 0) {
            block = static_cast<Index>(raster_.blocks.size());
            raster_.blocks.emplace_back();
            sums_.emplace_back();
        }
        return block;
    }

    static Vec2 area_and_height(const PiecePolygon& piece, int floor) {
        Vec2 sums = Vec2::Zero();
        for (std::size_t k = 2; k < piece.count; ++k) {
            const Vec3& a = piece.corners[0];
            const Vec3& b = piece.corners[k - 1];
            const Vec3& c = piece.corners[k];
            const double area =
                0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
            sums += area * Vec2(1.0, (a.z() + b.z() + c.z()) / 3.0 - floor);
        }
        return sums;
    }

    static bool lies_within(const PiecePolygon& piece, const std::array<int, 3>& fine) {
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < piece.count; ++k) {
            middle += piece.corners[k];
        }
        middle /= static_cast<double>(piece.count);
        const Vec3 low(fine[0], fine[1], fine[2]);
        return (middle.array() > low.array() + k_in_face).all() &&
               (middle.array() < low.array() + 1.0 - k_in_face).all();
    }

    LatticeRaster& raster_;
    std::vector<PieceSums>& sums_;
};

LatticeRaster cut_surface(const TriangleMesh& mesh, double spacing, std::vector<PieceSums>& sums) {
    LatticeRaster raster{.lattice = lattice_around(mesh, spacing), .cells = {}, .blocks = {}};
    const Lattice& lattice = raster.lattice;
    raster.cells.assign(lattice.cell_count(), LatticeRaster::k_outside);
    std::array<int, 3> fine_size{};
    std::transform(lattice.size.begin(), lattice.size.end(), fine_size.begin(),
                   [](int n) { return k_fine * n; });
    // Coordinates are taken from the middle of the lattice, which is that of the mesh: rounding is
    // least there.
    const Vec3 half = 0.5 * Vec3(fine_size[0], fine_size[1], fine_size[2]);
    const Vec3 middle = lattice.origin + half * (spacing / k_fine);
    PieceCollector collector(raster, sums);
    for (const Triangle& t : mesh.triangles) {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = (mesh.positions[at(t[k])] - middle) / (spacing / k_fine) + half;
        }
        for_each_piece(corners, fine_size,
                       [&](const std::array<int, 3>& fine, const PiecePolygon& piece) {
                           collector.add(fine, piece);
                       });
    }
    return raster;
}

/// A fine cell through which no piece of the surface passes is inside or outside as a whole.
void touch_full(LatticeBlock& block) {
    for (std::size_t i = 0; i < 64; ++i) {
        block.touched |= block.fractions[i] > 0.5 ? std::uint64_t{1} << i : 0;
    }
}

/// Goes down one column of cells. `areas` is what of each fine column's floor is inside.
void sum_column(LatticeRaster& raster, const std::vector<PieceSums>& sums, std::size_t column) {
    const auto& size = raster.lattice.size;
    const std::size_t layer = at(size[0]) * at(size[1]);
    std::array<double, 16> areas{};
    for (std::size_t z = at(size[2]); z-- > 0;) {
        Index& cell = raster.cells[column + layer * z];
        if (cell < 0) {
            const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
            cell = area > 8.0 ? LatticeRaster::k_full : LatticeRaster::k_outside;
            continue;
        }
        LatticeBlock& block = raster.blocks[at(cell)];
        for (std::size_t i = 64; i-- > 0;) {
            double& area = areas[i % 16];
            block.fractions[i] = std::clamp(area + sums[at(cell)].heights[i], 0.0, 1.0);
            area += sums[at(cell)].areas[i];
        }
        touch_full(block);
    }
}

} // namespace

std::size_t Lattice::cell_count() const {
    return at(size[0]) * at(size[1]) * at(size[2]);
}

Vec3 Lattice::corner(int x, int y, int z) const {
    return origin + spacing * Vec3(x, y, z);
}

Lattice lattice_around(const TriangleMesh& mesh, double spacing) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (const Vec3& x : mesh.positions) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    Lattice lattice{.origin = Vec3::Zero(), .spacing = spacing, .size = {}};
    const Vec3 middle = 0.5 * (low + high);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double cells = (high[i] - low[i]) / spacing;
        lattice.size[k] = std::max(1, static_cast<int>(std::ceil(cells * (1.0 - 1e-12))));
        lattice.origin[i] = middle[i] - 0.5 * spacing * lattice.size[k];
    }
    return lattice;
}

LatticeRaster raster_closed(const TriangleMesh& mesh, double spacing) {
    std::vector<PieceSums> sums;
    LatticeRaster raster = cut_surface(mesh, spacing, sums);
    const auto& size = raster.lattice.size;
    parallel_for(
        at(size[0]) * at(size[1]), [&](std::size_t c) { sum_column(raster, sums, c); }, 64);
    return raster;
}

LatticeRaster raster_by_winding(const TriangleMesh& mesh, double spacing) {
    std::vector<PieceSums> sums;
    LatticeRaster raster = cut_surface(mesh, spacing, sums);
    const WindingNumber winding(mesh);
    const auto& size = raster.lattice.size;
    parallel_for(raster.cells.size(), [&](std::size_t i) {
        const std::array<std::size_t, 3> c{i % at(size[0]), i / at(size[0]) % at(size[1]),
                                           i / at(size[0]) / at(size[1])};
        const Vec3 low = raster.lattice.corner(static_cast<int>(c[0]), static_cast<int>(c[1]),
                                               static_cast<int>(c[2]));
        Index& cell = raster.cells[i];
        if (cell < 0) {
            const bool is_inside = winding.around(low + Vec3::Constant(0.5 * spacing)) > 0.5;
            cell = is_inside ? LatticeRaster::k_full : LatticeRaster::k_outside;
            return;
        }
        LatticeBlock& block = raster.blocks[at(cell)];
        for (std::size_t f = 0; f < 64; ++f) {
            const Vec3 middle(static_cast<double>(f % 4) + 0.5,
                              static_cast<double>(f / 4 % 4) + 0.5,
                              static_cast<double>(f / 16) + 0.5);
            block.fractions[f] =
                winding.around(low + (spacing / k_fine) * middle) > 0.5 ? 1.0 : 0.0;
        }
        touch_full(block);
    });
    return raster;
}

} // namespace weft
