#pragma once

#include "state/cloth.h"

#include <string>

namespace weft {

/// One side of a seam: its vertices in order and their arc lengths at rest.
struct SeamChain {
    std::vector<Index> vertices; ///< the cloth's own indices
    std::vector<double> along;   ///< #vertices, arc length from the first, m

    double length() const { return along.back(); }
};

/// The vertices that a side of an `[[attach]]` names: its list, or the border from one vertex to
/// another, the shorter way round or the one that passes `via`. Throws Error (BadInput) that begins
/// with `place`: an index out of range, a place further than `radius` from the border, ends that no
/// border joins.
///
/// @param positions  positions of the cloth's vertices at t = 0, m
SeamChain build_seam_chain(const Cloth& cloth,
                           const AttachSide& side,
                           double radius,
                           const std::string& place,
                           std::span<const Vec3> positions);

/// A vertex of one chain and its point on the other.
struct SeamMatch {
    std::size_t vertex;  ///< index into the finer chain
    std::size_t segment; ///< index into the coarser chain of the segment's first vertex
    double weight;       ///< weight of the segment's second vertex, [0, 1]
};

/// For each vertex of `fine` the point of `coarse` at the same fraction of the length, as both are
/// to become one line. Where a vertex of `coarse` is near, the point is that vertex, so that equal
/// chains join vertex by vertex. Only the finer one is tied; tying both would hold the seam
/// straight.
std::vector<SeamMatch> match_chains(const SeamChain& fine, const SeamChain& coarse);

} // namespace weft
