#pragma once

#include "base/eigen.h"

namespace weft {

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
    /// Of the four vertices: sum 1 on side 1, -1 on side 2; sum of weights times positions =
    /// distance times normal.
    std::array<double, 4> weights;
};

Separation separation(PairKind kind, const PairPoints& x);

/// Least of n . (point of side 1 - point of side 2) over both sides: a lower bound of their
/// distance when n is a unit vector, negative when n does not separate them.
double gap_along(PairKind kind, const PairPoints& x, const Vec3& n);

} // namespace weft
