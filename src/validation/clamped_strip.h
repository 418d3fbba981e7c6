#pragma once

#include "geometry/sheet.h"

namespace weft {

/// A strip along x whose first column of cells is a clamp: points with x <= 0 are to be held.
///
/// An edge on the clamp's line bends like half a cell of the clamp and half a cell of the strip,
/// so that the strip begins half a cell before that line; its free end is `length` from there, at
/// x = length - cell/2. Without this its rigidity seems to be wrong by a cell in length.
struct ClampedStrip {
    Sheet sheet;
    double cell; ///< along x, m

    /// @param cells  along the strip, without the clamp's
    ClampedStrip(Pattern pattern, int cells, int cells_across, double length, double width);

    std::vector<Index> clamp() const;
    std::vector<Index> free_end() const;
};

/// Rows across that make the cells of a strip as square as can be; >= 1.
int square_cells_across(int cells, double length, double width);

} // namespace weft
