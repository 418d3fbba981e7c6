#pragma once

#include "state/world.h"

namespace weft {

/// The surfaces that cloth is taken out of.
struct UntangleFrom {
    bool obstacles = true;
    bool cloth = true; ///< other cloth and itself
};

struct UntangleReport {
    std::size_t pairs_before = 0; ///< pairs of triangles that crossed
    std::size_t pairs_after = 0;  ///< pairs that still do
    int rounds = 0;
    double max_displacement = 0.0; ///< greatest of all vertices, m
};

/// Takes cloth that crosses apart by geometry alone: changes world.positions of the cloths, each
/// layer in turn from the lowest, against the obstacles and the layers below, which stand. What is
/// behind an obstacle's surface goes to its outer side, and cloth to the outer side of cloth below
/// it; cloth of one layer, and cloth that crosses itself, parts by shortening the curves in which
/// it crosses. Meanwhile the cloth's edges pull towards the lengths that they had. Pinned vertices
/// move like others. At the end what was near keeps a clearance of half the thickness.
/// Source: Volino and Magnenat-Thalmann 2006; Baraff et al. 2003 for the flood over what is behind;
/// Mueller et al. 2007, position based dynamics.
UntangleReport untangle(World& world, const UntangleFrom& from = {});

} // namespace weft
