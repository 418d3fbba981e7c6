#pragma once

#include "adapt/sqrt3_mesh.h"
#include "state/world.h"

#include <span>
#include <vector>

namespace weft {

/// Carries the friction history of a cloth's pairs over an adaptation of its mesh.
///
/// Which pairs come after it only the next search tells. What goes on is the force of friction: a
/// pair's is its slip times a stiffness that no mesh changes. It is laid to the cloth's vertices of
/// the pair, in equal parts, as traction per mass; a vertex put in has the weighted mean of its
/// parents' traction, one that stays has its own, and the mass that they have then makes it a force
/// again, to be shared among the pairs found there. So the sum is kept as exactly as traction is
/// even; what a vertex taken out carried comes back through the mass that its neighbours gain.
///
/// In this order: the constructor, inherit() for each vertex put in, renumber_world(), leave().
class FrictionTransfer {
public:
    /// Takes out of the history all pairs with a vertex that changes.
    ///
    /// @param world       numbered, with masses, as before the adaptation
    /// @param first       first vertex of the cloth
    /// @param is_changed  of the cloth's vertices before it: corner of a triangle that changes, or
    ///                    taken out
    FrictionTransfer(World& world, Index first, std::span<const char> is_changed);

    /// Vertices by the numbers that they had during the adaptation, ascending.
    void inherit(const VertexParents& place);

    /// Puts the transfers into the history, which stays sorted.
    ///
    /// @param world   renumbered
    /// @param former  of each vertex of the cloth: its number during the adaptation
    /// @param masses  of each vertex of the cloth, kg
    void leave(World& world, std::span<const Index> former, std::span<const double> masses) const;

private:
    void take(const World& world, const FrictionHistory& pair);
    void add(const World& world,
             Index vertex,
             Index partner,
             const FrictionHistory& pair,
             double weight);
    void join_equal();
    std::span<const FrictionHistory> of(Index vertex) const;

    Index first_, old_count_;
    std::vector<Index> objects_; ///< first vertices, ascending, numbered as before
    /// By pair {v, v, v, u}, ascending: v a vertex of the cloth by its number during the
    /// adaptation, u as before it; slip per mass, m/kg.
    std::vector<FrictionHistory> transfers_;
};

} // namespace weft
