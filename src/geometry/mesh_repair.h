#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// What orient_consistently() did.
struct OrientReport {
    std::vector<Index> flipped; ///< triangles whose corner order was reversed, ascending
    bool is_orientable = true;  ///< false: a part has one side only (a Moebius strip)
};

/// Gives the triangles of each part one outer side: neighbours across an edge of exactly two
/// triangles run along it in opposite directions. The smaller group of a part is reversed (the one
/// without its first triangle when both are equal). A part that cannot be oriented is left as it
/// is.
///
/// @param triangles  in and out: corners 1 and 2 of a flipped one change places
OrientReport orient_consistently(std::vector<Triangle>& triangles);

/// Signed volume that a closed, consistently wound mesh encloses, m^3; negative when inside out.
double enclosed_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles);

} // namespace weft
