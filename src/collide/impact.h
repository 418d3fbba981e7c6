#pragma once

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
    double thickness_fraction; ///< of the pair's thickness, (0, 1)
    double start_fraction;     ///< of the pair's distance at the start, (0, 1)
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

} // namespace weft
