#pragma once

#include "geometry/lattice.h"
#include "geometry/lattice_raster.h"

namespace weft {

/// Fills what a raster of `surface` holds; without places when that is nothing.
///
/// Parts of the surface's inside that pass through one cell side by side get a copy of that cell
/// each when a layer of fine cells (k_fine a cell) lies free between them, and the copies share
/// particles only where the inside goes on from cell to cell. So parts that lie nearer together
/// are joined, and what is connected stays so however thin it is. Each vertex of the surface is
/// carried by a corner tetrahedron of its cell (Kuhn's division into six, the same in all cells,
/// so that places depend continuously on particles). The volume of a fine cell goes to the eight
/// corners of its cell by its middle's trilinear weights: whole cells give an eighth to each.
/// Source: Nesme, Kry, Jerabkova and Faure 2009 (cells by connected parts).
LatticeFill fill_lattice(const LatticeRaster& raster, const TriangleMesh& surface);

} // namespace weft
