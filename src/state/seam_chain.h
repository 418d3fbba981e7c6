#pragma once

#include "state/cloth.h"

#include <string>

namespace weft {

/// One side of a seam: vertices in order, and how far along each stands at rest.
struct SeamChain {
    std::vector<Index> vertices; ///< of the cloth
    std::vector<double> along;   ///< #vertices, m at rest, from 0

    double length() const { return along.back(); }
};

/// The vertices that a side of an `[[attach]]` names: its list, or the border from one vertex to
/// another, the shorter way round or the one that passes `via`. Throws Error (BadInput) that begins
/// with `place`: an index out of range, a place further than `radius` from the border, ends that no
/// border joins.
///
/// @param positions of the cloth's vertices at t = 0
SeamChain build_seam_chain(const Cloth& cloth,
                           const AttachSide& side,
                           double radius,
                           const std::string& place,
                           std::span<const Vec3> positions);

/// A vertex of one chain and its point on the other.
struct SeamMatch {
    std::size_t vertex;  ///< place in the finer chain
    std::size_t segment; ///< place in the coarser chain of the segment's first vertex
    double weight;       ///< of the segment's second vertex, [0, 1]
};

/// For each vertex of `fine` the point of `coarse` at the same share of the length, for both are to
/// become one line: a vertex itself where that is near, so that equal chains join vertex by vertex.
/// Only the finer one is tied; tying both would hold the seam straight.
std::vector<SeamMatch> match_chains(const SeamChain& fine, const SeamChain& coarse);

} // namespace weft
