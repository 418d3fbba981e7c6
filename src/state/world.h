#pragma once

#include "scene/scene.h"
#include "state/attachment.h"
#include "state/body.h"
#include "state/cloth.h"
#include "state/friction_history.h"
#include "state/obstacle.h"
#include "state/pin.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// Everything that changes in time, and what the next substep depends on: two Worlds with the same
/// content continue to the same bits. The vertices of all that moves by forces stand in the arrays
/// one object after the other: cloths, solids, rigid bodies. Those that a body's particles carry
/// (body.h) have no mass and are where these put them.
struct World {
    double time = 0.0; ///< s
    int frame = 1;     ///< the frame that the state stands at: frame n is t = (n-1)/fps

    std::vector<Vec3> positions;  ///< #V, m
    std::vector<Vec3> velocities; ///< #V, m/s
    std::vector<double> masses;   ///< #V, kg, > 0; 0 of carried vertices

    /// State one substep ago for BDF2; valid for vertex i while history_dt > 0 and its entry is
    /// finite.
    std::vector<Vec3> previous_positions;  ///< #V
    std::vector<Vec3> previous_velocities; ///< #V
    double history_dt = 0.0;               ///< s, length of the last substep; 0 = no history

    std::vector<FrictionHistory> friction_history; ///< by ascending pair, each pair once

    std::vector<Cloth> cloths;
    std::vector<Solid> solids;
    std::vector<RigidBody> rigids;
    std::vector<Obstacle> obstacles;
    std::vector<Pin> pins; ///< by ascending vertex, each vertex once
    std::vector<PinGroup> pin_groups;

    std::vector<Attachment> attachments;
    std::vector<AttachedPair> attached_pairs;   ///< by attachment
    std::vector<AttachedState> attached_states; ///< #attached_pairs

    std::size_t vertex_count() const { return positions.size(); }
    std::size_t triangle_count() const;
    std::span<const Vec3> positions_of(const Cloth& cloth) const;
    std::span<const Vec3> velocities_of(const Cloth& cloth) const;
};

/// Calls f(const Body&) for each solid, then for each rigid body.
template <typename F> void for_each_body(const World& world, const F& f) {
    for (const Solid& solid : world.solids) {
        f(solid.body);
    }
    for (const RigidBody& rigid : world.rigids) {
        f(rigid.body);
    }
}

/// Sets what stands for carried vertices in `values` (#V: positions, velocities) to what their
/// particles' values make of it.
void carry(const World& world, std::span<Vec3> values);

/// How often the mesh of each cloth has been adapted: other numbers, perhaps another mesh.
std::vector<Index> adaptations_of(const World& world);

/// What is wrong with a world (sizes, indices, values not finite), or "". For asserts and tests.
std::string check(const World& world);

/// FNV-1a of time, positions, velocities and history: equal for equal states.
std::uint64_t state_hash(const World& world);

/// Loads meshes, builds rest shapes, masses, obstacles and pins. `warn` receives one line each.
/// Throws Error (BadInput) naming the object and key.
World build_world(const Scene& scene, const std::function<void(const std::string&)>& warn);

} // namespace weft
