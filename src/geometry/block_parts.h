#pragma once

#include "base/eigen.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// Sets of the 64 fine cells of a lattice's cell as bits: fine cell (x, y, z) is bit
/// x + 4 (y + 4 z).

/// The parts of a set that are connected through faces of fine cells, by their lowest bits.
std::vector<std::uint64_t> connected_sets(std::uint64_t set);

/// Do a set of one cell and a set of the next one along an axis (0, 1, 2) meet in the common face?
bool meet_over_face(std::uint64_t low, std::uint64_t high, int axis);

/// Sum over a set of share times the trilinear weight of a corner (x + 2 y + 4 z) at the middle of
/// the fine cell, in volumes of the cell.
double corner_share(const std::array<double, 64>& shares, std::uint64_t set, int corner);

} // namespace weft
