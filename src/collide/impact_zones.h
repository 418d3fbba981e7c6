#pragma once

#include "base/disjoint_sets.h"
#include "collide/impact.h"

namespace weft {

/// Sets of vertices that impacts have joined, each solved as one. Vertices of infinite mass join
/// nothing: two heaps on one table are two zones.
class ImpactZones {
public:
    void reset(std::size_t vertex_count);

    /// Every vertex is alone, but each body is one zone: its vertices go where its particles do.
    void reset(const ContactSurface& surface);

    /// Joins the vertices of finite mass of a pair.
    void join(const ContactSurface& surface, const std::array<Index, 4>& vertices);

    /// Name of the zone of a vertex: its least vertex.
    Index of(Index vertex) const;

    /// The fail-safe: scales down the motion of each zone that still has an impact, relative to a
    /// reference motion that brings its vertices no nearer to each other. With factor 0 there are
    /// no impacts inside the zone. The reference motion is
    ///
    /// - that of the obstacle which the zone meets; of several, of the last one that moves; of an
    ///   obstacle that changes its shape, the rigid motion nearest to that of its vertices met;
    /// - else the mean velocity of the held vertices that the zone meets;
    /// - else the rigid motion with the zone's momentum and angular momentum.
    ///
    /// @param strength 1: motion up to 0.8 times the zone's earliest time of impact is kept; 0:
    /// none
    /// @param touched  set to 1 for vertices whose velocity changed
    /// @return zones whose motion was scaled down
    /// Source: rigid zones after Provot 1997 and Bridson et al. 2002.
    int scale_motion(ContactSurface& surface,
                     std::span<const Candidate> candidates,
                     std::span<const Impact> impacts,
                     double strength,
                     double dt,
                     std::span<char> touched) const;

private:
    DisjointSets sets_;
};

} // namespace weft
