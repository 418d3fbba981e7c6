#pragma once

#include "base/eigen.h"

#include <array>
#include <cstdint>

namespace weft {

/// What one substep of contact hands on to the next: the history of a pair, or a transfer to a
/// vertex (transfer_key). Where friction is decided: collide/friction.h.
struct FrictionHistory {
    std::array<Index, 4> pair; ///< vertices of the contact surface
    double rest_gap;           ///< the pair pushes only while its gap is smaller, m
    Vec3 slip;                 ///< displacement of its friction spring, m
    std::int64_t slides;       ///< 1 above the limit of friction, else 0; wide: no padding
};
static_assert(sizeof(FrictionHistory) == 56, "is hashed and stored as bytes");

/// Key of a transfer. An adaptation of the mesh ends the pairs at the vertices that it changes;
/// each of these vertices keeps its part of their slips as one transfer for every object that it
/// touched, and the pairs that the next search finds there divide it among them.
///
/// A transfer is an entry of World::friction_history with this key as its pair. Its slip is the sum
/// of the vertex's parts, in the direction in which the vertex slips over the object.
/// @param vertex   of the adapted cloth
/// @param partner  first vertex of the object that it touches
inline std::array<Index, 4> transfer_key(Index vertex, Index partner) {
    return {vertex, vertex, vertex, partner};
}

/// Is the entry a transfer? The vertices of a pair are all different.
inline bool is_transfer(const FrictionHistory& history) {
    return history.pair[0] == history.pair[1];
}

} // namespace weft
