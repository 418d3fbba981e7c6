#pragma once

#include "adapt/adaptation_hooks.h"
#include "adapt/friction_transfer.h"
#include "adapt/patch_momentum.h"
#include "state/refinement.h"
#include "state/world.h"

#include <optional>
#include <vector>

namespace weft {

/// What the vertices of one cloth carry through an adaptation.
///
/// A vertex put in stands, and moves, where the surface did: at the weighted mean of its parents,
/// in the history that BDF2 needs as well; it is pinned when all its parents are, by one pin. A
/// vertex taken out leaves its momentum. Lumped masses change around all that is edited; then each
/// connected patch of changed triangles, with some more around it, gets back the linear and angular
/// momentum that it had; so do the changes of velocity that BDF2 goes on from. Friction goes on as
/// FrictionTransfer says.
class StateTransfer {
public:
    StateTransfer(const World& world, const Cloth& cloth);

    void insert(const VertexParents& place);
    void remove(const VertexParents& place);
    void move(Index from, Index to);

    /// Positions as the mesh stands now, by slot, m.
    const Vec3& position(Index v) const { return states_[static_cast<std::size_t>(v)].x; }

    /// Whether nothing holds a vertex where it is: no pin, no attached pair, no contact.
    bool is_free(Index v) const { return !states_[static_cast<std::size_t>(v)].is_held; }

    /// Shifts a vertex of the cloth as the adaptation left it, and where it comes from with it, so
    /// that it moves as before.
    void shift(Index v, const Vec3& x);

    /// The adaptation gave the cloth this much energy (J) around a vertex: what it moves by is to
    /// lose as much, as far as restore_momentum() takes it.
    void charge(Index v, double energy) {
        states_[static_cast<std::size_t>(v)].left.kinetic -= energy;
    }

    /// All of them, of the cloth as the adaptation left it.
    std::vector<Vec3> positions(const Cloth& cloth) const;

    /// Writes the state of the changed cloth number `index` into the world, whose mesh has been
    /// changed already, and corrects velocities.
    void finish(World& world, std::size_t index, const ClothChanges& changes);

private:
    struct VertexState {
        Vec3 x, v, previous_x, previous_v, start;
        double mass = 0.0;         ///< before the adaptation, kg; 0: it is new
        PatchMomentum left;        ///< by vertices that were taken out
        PatchMomentum left_change; ///< the same of what the last substep changed of their velocity
        std::optional<Pin> pin;
        Index former = 0;     ///< slot until finish
        bool is_held = false; ///< by a pin, an attached pair or contact
    };

    void find_held(const World& world, const Cloth& cloth);

    std::optional<Pin> common_pin(const VertexParents& place) const;
    void set_masses(const Cloth& cloth, const ClothChanges& changes);
    void correct_velocities(const Cloth& cloth, const ClothChanges& changes);
    void correct_patch(std::span<const Index> patch);
    FrictionTransfer
    begin_friction_transfer(World& world, const Cloth& cloth, const ClothChanges& changes) const;
    void end_friction_transfer(World& world, const FrictionTransfer& transfer) const;

    const std::vector<Obstacle>* obstacles_;
    Vec3 origin_;
    std::vector<VertexState> states_; ///< by slot
    std::vector<double> masses_;      ///< by slot, after the adaptation, kg
    std::vector<VertexParents> inserted_;
    std::size_t old_count_;
};

} // namespace weft
