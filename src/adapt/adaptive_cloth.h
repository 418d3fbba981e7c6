#pragma once

#include "state/cloth.h"

#include <string>

namespace weft {

/// Rest lengths of an edge that differ by more, relative, are two lengths: cloth gathered into a
/// seam. Far above what single precision in a file leaves, far below what is sewn on purpose.
inline constexpr double k_same_length = 1e-6;

/// Material frames on the two sides of an edge that differ by more are two cuts of cloth: a seam,
/// or a fold of the grain. A flip gives both triangles the mean frame, half of this off, which
/// changes an orthotropic stiffness by less than 4 % (cos^4 of 7.5 degrees). Smaller locks the
/// edges of finely curved rest shapes; larger blurs seams.
inline constexpr double k_same_grain_deg = 15.0;

/// Makes a cloth's mesh adaptive: fills cloth.refinement for the mesh as it is, no triangle frozen.
/// Locked are inner edges with two rest lengths or two grains. O(#triangles).
void make_refinement(Cloth& cloth);

/// Says what is wrong with an adaptive cloth, or "". It checks sizes, edges against build_edges,
/// Euler number, generations across edges and at vertices, flips that wait, rest areas and lengths.
/// Slow: looks at everything. For asserts of debug builds and for tests.
std::string check_refinement(const Cloth& cloth);

} // namespace weft
