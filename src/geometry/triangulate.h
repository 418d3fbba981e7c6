#pragma once

#include "base/eigen.h"

#include <span>
#include <vector>

namespace weft {

/// Triangles of a polygon in space, as triples of indices into `corners`; n - 2 of them, wound like
/// the polygon.
///
/// Quads are cut along the shorter diagonal (0-2 when they differ by less than a thousandth, so
/// that a regular grid stays regular) unless that one leaves the polygon; larger ones by ear
/// clipping in the plane of their mean (Newell) normal. A polygon that crosses itself or has no
/// area still yields n - 2 triangles, some of them without area. Fewer than three corners yield
/// none.
std::vector<Triangle> triangulate_polygon(std::span<const Vec3> corners);

} // namespace weft
