#pragma once

#include "state/contact_memory.h"

namespace weft {

/// Pairs whose mesh is adapted are no more. They leave legacies to the vertices there, which the
/// pairs found next share among them: an entry of World::contact_memory whose pair is this, with
/// `vertex` one of the adapted cloth and `partner` the first vertex of the object that it touches.
/// Its slip is the sum of the vertex's part in the slips of all its pairs with that object, seen
/// from the vertex.
inline std::array<Index, 4> legacy_pair(Index vertex, Index partner) {
    return {vertex, vertex, vertex, partner};
}

/// In a pair no vertex comes twice.
inline bool is_legacy(const ContactMemory& memory) {
    return memory.pair[0] == memory.pair[1];
}

} // namespace weft
