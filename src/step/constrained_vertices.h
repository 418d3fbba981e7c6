#pragma once

#include "state/world.h"

namespace weft {

/// Vertices whose position at the end of a substep is given (Dirichlet conditions).
struct ConstrainedVertices {
    std::vector<char> flags;   ///< #V; 1 = constrained
    std::vector<Vec3> targets; ///< #V; position at the end of the substep, m; 0 where free
};

/// Finds the vertices that pins constrain in a substep that ends at `end_time` (s).
void find_constrained(const World& world, double end_time, ConstrainedVertices& constrained);

} // namespace weft
