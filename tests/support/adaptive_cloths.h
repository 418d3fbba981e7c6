#pragma once

#include "geometry/shapes.h"
#include "state/cloth.h"

namespace weft::test {

/// A flat cloth whose mesh can be refined.
Cloth adaptive_sheet(const Sheet& sheet);

/// A grid with random diagonals and points moved by up to `jitter` cells, the boundary's as well.
Sheet rough_sheet(int cells, double jitter, unsigned seed);

/// A cylinder about the y axis, radius 1 m, height 1 m, `around` by `up` cells, closed around; or
/// with the axis along x, where its material frame jumps twice.
Cloth adaptive_cylinder(int around, int up, bool is_lying = false);

/// A closed surface without curvature: a grid of `cells` squares a side, each cut along one
/// diagonal, whose opposite sides are one.
Cloth flat_torus(int cells);

/// Three triangles about a vertex, and a fourth that touches one of theirs in its corner alone.
Sheet pinched_sheet();

/// A sheet of `cells` squares a side whose right half is cut a tenth larger and with its grain
/// turned by 30 degrees, sewn to the left one: a seam down the middle.
Cloth seamed_sheet(int cells);

/// The same with the larger piece an island of 2 by 2 cells within.
Cloth patched_sheet(int cells);

/// One of each of nine kinds of mesh, by turns: the above and regular ones.
Cloth some_cloth(unsigned seed);

} // namespace weft::test
