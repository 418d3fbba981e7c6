#pragma once

#include "state/world.h"

namespace weft {

/// Where the vertices of all that moves by forces were at t = 0: trees made of these places are the
/// same whenever they are made, so that a resumed run goes on to the same bits.
class StartPositions {
public:
    /// @param start  the world at t = 0
    explicit StartPositions(const World& start);

    /// #V, m, by the numbers that vertices have now; those of adaptive cloths as refinement
    /// remembers them.
    std::vector<Vec3> of(const World& world) const;

private:
    std::vector<std::vector<Vec3>> cloths_; ///< positions; none of adaptive ones
    std::vector<Vec3> bodies_;              ///< of all solids and rigid bodies
};

} // namespace weft
