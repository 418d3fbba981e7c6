#pragma once

#include "state/world.h"

namespace weft {

/// A pin that a rigid body leads is a joint: each pulls the other.
struct Joint {
    std::string name;                ///< for messages
    std::span<const Index> vertices; ///< of World, solved for
    Index rigid;                     ///< of World::rigids
    double stiffness;                ///< of what is joined, N/m
    double until = k_forever;        ///< s
};

/// Joins vertices, from the places where they are, to the body, by pairs that are welded from the
/// start. Before any pair has a state.
void join_to_rigid(World& world, const Joint& joint);

} // namespace weft
