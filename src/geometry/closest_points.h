#pragma once

#include "base/eigen.h"

namespace weft {

/// Parameter in [0, 1] of the point of segment a + s (b - a) nearest to p; 0 when a == b.
double closest_weight_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Weights (>= 0, sum 1) of the point of triangle (a, b, c) nearest to p. A triangle without area
/// counts as its three sides.
Vec3 closest_weights_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Parameters (s, t) in [0, 1] of the nearest points a0 + s (a1 - a0) and b0 + t (b1 - b0). Of
/// parallel segments with many nearest pairs one that contains an end point.
///
/// Segments closer to parallel than 3e-8 rad count as parallel: the distance is then too large by
/// at most 3e-8 of their length.
Vec2 closest_weights_on_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1);

} // namespace weft
