#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// Vertices joined by position: `positions` are the kept ones in the order of their first
/// appearance, `new_index[old]` is where each old one went.
struct Weld {
    std::vector<Vec3> positions;
    std::vector<Index> new_index;
};

/// Joins vertices that lie within `tolerance` (m, >= 0; 0 joins equal ones only) of one another.
///
/// Each vertex in turn goes to the nearest vertex kept so far (the lower number at equal distance)
/// or is kept itself, so the result depends on the order of the input alone and no vertex moves by
/// more than `tolerance`. Requires finite positions.
Weld weld_vertices(std::span<const Vec3> positions, double tolerance);

/// Diagonal of the bounding box of the finite ones among `positions`; 0 when there are none.
double bounding_diagonal(std::span<const Vec3> positions);

} // namespace weft
