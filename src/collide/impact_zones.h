#pragma once

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "collide/contact_row.h"
#include "geometry/distance.h"

namespace weft {

/// A pair that comes too near during the substep.
struct Impact {
    Index candidate;
    double toi; ///< in [0, 1] of the substep: up to then the pair keeps its distance
};

/// How near pairs may come, by their thickness; the lesser of the two holds.
struct ImpactLimit {
    double thickness_fraction; ///< fraction of the pair's thickness, (0, 1)
    double start_fraction;     ///< fraction of the pair's distance at the start, (0, 1)
};

/// Continuous detection over candidates.
class ImpactSearch {
public:
    /// All impacts, in the order of the candidates. Looks only at candidates with a vertex for
    /// which look[v] != 0. Pairs that touch at the start cannot be kept apart and are left out.
    void find(const ContactSurface& surface,
              std::span<const Candidate> candidates,
              std::span<const char> look,
              double dt,
              const ImpactLimit& limit,
              std::vector<Impact>& impacts);

private:
    ChunkLists<Impact> chunks_;
};

/// The condition that stops an impact: seen where the pair meets, the sides may use up the distance
/// beyond their thickness and no more.
ContactRow
make_impact_row(const ContactSurface& surface, const Candidate& candidate, double toi, double dt);

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
