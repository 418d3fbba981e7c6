#pragma once

#include "state/world.h"

namespace weft {

/// What carries each vertex of a world, its particles numbered as in World.
struct CarrierTable {
    std::vector<Index> slot;       ///< #V; k_no_index: nothing does; empty: of no vertex
    std::vector<Carrier> carriers; ///< by slot

    /// None: the vertex is solved for itself.
    const Carrier* of(Index vertex) const {
        if (slot.empty()) {
            return nullptr;
        }
        const Index i = slot[static_cast<std::size_t>(vertex)];
        return i == k_no_index ? nullptr : &carriers[static_cast<std::size_t>(i)];
    }
};

CarrierTable make_carrier_table(const World& world);

} // namespace weft
