#pragma once

#include "base/disjoint_sets.h"
#include "collide/impact.h"

namespace weft {

/// Sets of vertices that impacts have joined. Vertices of infinite mass join nothing: two heaps on
/// one table are two islands.
class Islands {
public:
    void reset(std::size_t vertex_count);

    /// Every vertex alone, but each body one island: its vertices go where its particles do.
    void reset(const ContactSurface& surface);

    /// Joins the vertices of finite mass of a pair.
    void join(const ContactSurface& surface, const std::array<Index, 4>& vertices);

    /// Name of the island of a vertex: its least vertex.
    Index of(Index vertex) const;

private:
    DisjointSets sets_;
};

/// The last resort: cuts back the motion of every island that still has an impact, relative to a
/// motion that brings its vertices no nearer to each other, so that `factor` = 0 is free of impacts
/// inside it. That motion is: the one of the obstacle that the island meets (of the last moving one
/// if several; of a deforming one the rigid motion nearest to that of its vertices that are met),
/// else the mean velocity of the held vertices it meets, else the rigid motion with
/// the island's momentum and angular momentum.
///
/// @param strength 1: motion up to 0.8 times the island's earliest time of impact is kept; 0: none
/// @param touched  set to 1 for vertices whose velocity changed
/// @return islands cut back
/// Source: rigid zones after Provot 1997 and Bridson et al. 2002.
int cut_back(ContactSurface& surface,
             std::span<const Candidate> candidates,
             std::span<const Impact> impacts,
             const Islands& islands,
             double strength,
             double dt,
             std::span<char> touched);

} // namespace weft
