#pragma once

#include "state/world.h"

/// The two ways back: to the start of a frame that was stopped, and out of a tangle.
namespace weft {

/// A state that a world can be taken back to within a frame: all that substeps change.
class Snapshot {
public:
    explicit Snapshot(const World& world)
        : time_(world.time), history_dt_(world.history_dt), positions_(world.positions),
          velocities_(world.velocities), masses_(world.masses),
          previous_positions_(world.previous_positions),
          previous_velocities_(world.previous_velocities),
          friction_history_(world.friction_history), cloths_(world.cloths), pins_(world.pins),
          attached_pairs_(world.attached_pairs), attached_states_(world.attached_states) {}

    void restore(World& world) const {
        world.time = time_;
        world.history_dt = history_dt_;
        world.positions = positions_;
        world.velocities = velocities_;
        world.masses = masses_;
        world.previous_positions = previous_positions_;
        world.previous_velocities = previous_velocities_;
        world.friction_history = friction_history_;
        world.cloths = cloths_;
        number_bodies(world);
        world.pins = pins_;
        world.attached_pairs = attached_pairs_;
        world.attached_states = attached_states_;
    }

private:
    double time_, history_dt_;
    std::vector<Vec3> positions_, velocities_;
    std::vector<double> masses_;
    std::vector<Vec3> previous_positions_, previous_velocities_;
    std::vector<FrictionHistory> friction_history_;
    std::vector<Cloth> cloths_;
    std::vector<Pin> pins_;
    std::vector<AttachedPair> attached_pairs_;
    std::vector<AttachedState> attached_states_;
};

/// Parts cloth that was pinched until it crossed, where obstacles leave room again, by geometry
/// alone (collide/untangle.h). Velocities stay, so that no work is done. When pairs are left
/// crossing, nothing changes.
/// @returns whether no pair crosses any more
bool recover_from_crossings(World& world);

} // namespace weft
