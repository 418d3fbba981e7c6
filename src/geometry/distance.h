#pragma once

#include "base/eigen.h"

#include <optional>

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

/// The two kinds of pairs that surfaces meet in. Side 1 is vertex 0 (VertexFace) or vertices 0, 1
/// (EdgeEdge); side 2 is the rest of the four.
///
///        0                      0 ---+--- 1
///        |                           |
///     1 -+- 2  with 3           2 ---+--- 3
enum class PairKind : std::uint8_t { VertexFace, EdgeEdge };

/// Vertices of side 1.
inline std::size_t first_side(PairKind kind) {
    return kind == PairKind::VertexFace ? 1 : 2;
}

/// Four points of a pair, or their displacements, m.
using PairPoints = std::array<Vec3, 4>;

/// The shortest connection between the two sides.
struct Separation {
    double distance; ///< m
    Vec3 normal;     ///< unit, from side 2 to side 1; zero when the distance is
    /// Weights of the four vertices: they sum to 1 on side 1 and to -1 on side 2, and the sum of
    /// weights times positions is distance times normal.
    std::array<double, 4> weights;
};

Separation separation(PairKind kind, const PairPoints& x);

/// Least of n . (point of side 1 - point of side 2) over both sides: a lower bound of their
/// distance when n is a unit vector, negative when n does not separate them.
double gap_along(PairKind kind, const PairPoints& x, const Vec3& n);

/// The least distance that the two sides of a pair may come to: the lesser of a distance and a
/// fraction of the distance they start at, so that a pair that starts too near may stay where it
/// is.
struct ApproachLimit {
    double distance;       ///< m, >= 0
    double fraction = 0.5; ///< fraction of the start distance, [0, 1)
};

/// Conservative continuous detection: the four points move linearly, x + t * displacement. Returns
/// nothing only if the sides stay further apart than the limit allows for all t in [0, 1];
/// otherwise a time up to which they do, near the first time that the gap above the limit falls to
/// a tenth of what it was. 0 for sides that touch at the start.
///
/// Source: additive continuous detection, Li et al. 2021 (C-IPC), section 4.4, with a longer step
/// where the direction between the closest points separates the sides.
std::optional<double> time_of_impact(PairKind kind,
                                     const PairPoints& start,
                                     const PairPoints& displacement,
                                     const ApproachLimit& limit);

} // namespace weft
