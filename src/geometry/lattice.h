#pragma once

#include "geometry/triangle_mesh.h"

#include <array>
#include <vector>

namespace weft {

/// Corners of a cell of a lattice: corner (x, y, z) at x + 2 y + 4 z.
using CellCorners = std::array<Index, 8>;

/// A place as the weighted sum of up to four particles: weights >= 0 that sum to 1. Those that
/// are not used come last, with k_no_index and 0.
struct LatticePlace {
    std::array<Index, 4> particles{k_no_index, k_no_index, k_no_index, k_no_index};
    std::array<double, 4> weights{0.0, 0.0, 0.0, 0.0};
};

/// A solid made of particles on a cubic lattice: the corners of all cells that hold part of it.
struct LatticeFill {
    double spacing = 0.0;             ///< m
    std::vector<Vec3> particles;      ///< places, m; several may share one, see fill_lattice()
    std::vector<double> volumes;      ///< #particles, part of the inside, m^3; may be 0
    std::vector<CellCorners> cells;   ///< numbers of particles
    TriangleMesh surface;             ///< closed unless the filled one is open
    std::vector<LatticePlace> places; ///< #vertices of the surface, where they stand
};

enum class LatticeEdgeKind { Side, FaceDiagonal, BodyDiagonal };

/// Two particles of one cell.
struct LatticeEdge {
    std::array<Index, 2> particles; ///< the lower first
    LatticeEdgeKind kind;
};

/// A box about the origin whose edges are whole numbers of cells: particles on its faces too, and
/// its outer quads, split in alternating directions, as the surface.
LatticeFill fill_box(const std::array<int, 3>& cells, double spacing);

/// All pairs of particles that share a cell, each once, by ascending particles: 26 neighbours
/// inside.
std::vector<LatticeEdge> lattice_edges(const LatticeFill& fill);

/// Six tetrahedra of a cell, all with corners 0 and 7 and of positive volume at rest (Kuhn 1960).
inline constexpr std::array<std::array<int, 4>, 6> k_cell_tetrahedra{
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

/// Masses by volume that sum to `mass`, kg. None is below a 64th of what a particle deep inside has
/// or, where all of it is thin, an eighth of the mean, so that no particle is too light for the
/// edges that hold it.
std::vector<double> lattice_masses(const LatticeFill& fill, double mass);

} // namespace weft
