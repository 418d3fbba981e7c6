#pragma once

#include "adapt/friction_transfer.h"
#include "adapt/sqrt3_mesh.h"
#include "base/eigen.h"
#include "state/refinement.h"
#include "state/world.h"

#include <optional>
#include <span>
#include <vector>

namespace weft {

/// Mass and motion of some vertices.
struct PatchMomentum {
    double mass = 0.0;           ///< kg
    Vec3 linear = Vec3::Zero();  ///< kg m/s
    Vec3 angular = Vec3::Zero(); ///< about the origin, kg m^2/s
    double kinetic = 0.0;        ///< J

    void add(double m, const Vec3& x, const Vec3& v);
    PatchMomentum& operator+=(const PatchMomentum& other);
};

/// Gives a patch of vertices at x (m) with masses m (kg) the linear and angular momentum `before`,
/// by the least change of their velocities v (m/s).
///
/// Where the patch has more kinetic energy than before after that, the velocities that differ from
/// its rigid motion are scaled down until it has not, by a fiftieth at most. A gain that is left
/// comes from masses that moved nearer to the axis of a spin; it is lost again when they move back.
/// Directions about which the vertices have next to no inertia keep their angular momentum.
void restore_momentum(const PatchMomentum& before,
                      std::span<const double> m,
                      std::span<const Vec3> x,
                      std::span<Vec3> v);

/// Carries the state of one cloth's vertices through an adaptation.
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
    const Vec3& position(Index v) const { return states_[at(v)].x; }

    /// Whether nothing holds a vertex where it is: no pin, no attached pair, no contact.
    bool is_free(Index v) const { return !states_[at(v)].is_fixed_for_remesh; }

    /// Shifts a vertex of the cloth as the adaptation left it, and where it comes from with it, so
    /// that it moves as before.
    void shift(Index v, const Vec3& x);

    /// Takes this much energy (J), which the adaptation gave the cloth around a vertex, off the
    /// kinetic energy there, as far as restore_momentum() can.
    void charge(Index v, double energy) { states_[at(v)].left.kinetic -= energy; }

    /// All of them, of the cloth as the adaptation left it.
    std::vector<Vec3> positions(const Cloth& cloth) const;

    /// Writes the state of the changed cloth number `index` into the world, whose mesh has been
    /// changed already, and corrects velocities.
    void finish(World& world, std::size_t index, const ClothChanges& changes);

private:
    struct VertexState {
        Vec3 x, v, previous_x, previous_v, start;
        double mass = 0.0;         ///< before the adaptation, kg; 0: it is new
        PatchMomentum left;        ///< momentum that vertices taken out have left
        PatchMomentum left_change; ///< the same for the change of velocity in the last substep
        std::optional<Pin> pin;
        Index former = 0;                 ///< slot until finish
        bool is_fixed_for_remesh = false; ///< a pin, an attached pair or contact fixes it
    };

    void find_fixed(const World& world, const Cloth& cloth);

    std::optional<Pin> common_pin(const VertexParents& place) const;
    void set_masses(const Cloth& cloth, const ClothChanges& changes);
    void correct_velocities(const Cloth& cloth, const ClothChanges& changes);
    void correct_patch(std::span<const Index> patch);
    FrictionTransfer
    begin_friction_transfer(World& world, const Cloth& cloth, const ClothChanges& changes) const;
    void end_friction_transfer(World& world, const FrictionTransfer& transfer) const;

    const std::vector<Obstacle>* obstacles_;
    Vec3 origin_;
    std::vector<VertexState> states_; ///< [slot]
    std::vector<double> masses_;      ///< [slot], after the adaptation, kg
    std::vector<VertexParents> inserted_;
    std::size_t old_count_;
};

} // namespace weft
