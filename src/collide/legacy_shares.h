#pragma once

#include "collide/contact.h"
#include "collide/contact_surface.h"

#include <span>
#include <vector>

namespace weft {

/// What is remembered of a pair; null: nothing.
/// @param memory  sorted by pair
const ContactMemory* find_pair(std::span<const ContactMemory> memory,
                               const std::array<Index, 4>& pair);

/// Shares the legacies of an adaptation (contact_legacy.h) among the pairs found after it.
///
/// Each pair that is not remembered itself has a part of those of its vertices which lie with the
/// object that it touches: in proportion to the vertex's weight in it and to how far it is within
/// its rest gap, as this much may friction hold. Of a legacy that any pair has a part of, nothing
/// is lost: sum of weight times slip is the same as before, but for what leans out of the normals'
/// planes.
class LegacyShares {
public:
    /// Adds to the slips of `contacts`, whose rest gaps are known.
    /// @param memory  sorted by pair
    void give(const ContactSurface& surface,
              std::span<const ContactMemory> memory,
              std::span<Contact> contacts);

private:
    std::vector<double> claims_; ///< on each of the memory's legacies, m
};

} // namespace weft
