#pragma once

#include "geometry/triangle_mesh.h"

#include <cstdint>
#include <vector>

namespace weft {

/// A cubic lattice of cells: cell (x, y, z) is number x + size[0] (y + size[1] z).
struct Lattice {
    Vec3 origin{0.0, 0.0, 0.0}; ///< low corner of cell 0, m
    double spacing = 1.0;       ///< edge of a cell, m
    std::array<int, 3> size{0, 0, 0};

    std::size_t cell_count() const;
    Vec3 corner(int x, int y, int z) const; ///< m
};

/// Fine cells along the edge of a cell; what lies nearer together than that is one part.
inline constexpr int k_fine = 4;

/// A cell that the surface passes through, cut into 64 fine ones: fine cell (x, y, z) is number
/// x + 4 (y + 4 z).
struct LatticeBlock {
    std::uint64_t touched = 0;          ///< bit i: part of the inside lies in fine cell i
    std::array<double, 64> fractions{}; ///< [i]: part of fine cell i that is inside, 0 to 1
};

/// The part of each cell of a lattice that lies inside a surface.
struct LatticeRaster {
    static constexpr Index k_outside = -1, k_full = -2;

    Lattice lattice;
    std::vector<Index> cells; ///< #cells: k_outside, k_full or the number of a block
    std::vector<LatticeBlock> blocks;
};

/// The lattice around a mesh: as few cells as hold its bounding box, which lies in their middle.
Lattice lattice_around(const TriangleMesh& mesh, double spacing);

/// The inside of a closed mesh that does not cross itself, its triangles counter-clockwise seen
/// from outside. The fractions are exact but for rounding: each triangle is cut at the planes of
/// the fine cells, and a column of them is summed up from above by the divergence theorem.
LatticeRaster raster_closed(const TriangleMesh& mesh, double spacing);

/// The inside of any mesh: where its generalized winding number exceeds one half, asked at the
/// centres of fine cells where the surface passes and at those of cells elsewhere.
/// Source: Jacobson, Kavan and Sorkine-Hornung 2013.
LatticeRaster raster_by_winding(const TriangleMesh& mesh, double spacing);

} // namespace weft
