#pragma once

#include "scene/object_kind.h"
#include "state/attachment.h"
#include "state/body.h"
#include "state/cloth.h"
#include "state/friction_history.h"
#include "state/obstacle.h"
#include "state/pin.h"

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// Everything that changes in time and that the next substep depends on: two Worlds with the same
/// content continue to the same bits. The arrays hold the vertices of all objects that forces move,
/// one object after the other: cloths, solids, rigid bodies. Embedded vertices (body.h) have no
/// mass; their particles determine where they are.
struct World {
    double time = 0.0; ///< s
    int frame = 1;     ///< number of the present frame; frame n is at t = (n-1)/fps

    std::vector<Vec3> positions;  ///< #V, m
    std::vector<Vec3> velocities; ///< #V, m/s
    std::vector<double> masses;   ///< #V, kg, > 0; 0 for embedded vertices

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

/// Sets the values of all embedded vertices from those of their particles. `values` is #V long:
/// positions or velocities.
void interpolate_embedded(const World& world, std::span<Vec3> values);

/// Extends previous_positions and previous_velocities to vertices that were appended at t = 0.
void extend_history(World& world);

/// The revision of each cloth's mesh: how often it has been adapted. Where a revision differs the
/// mesh may, too.
std::vector<Index> mesh_revisions(const World& world);

/// The first fault in a world (sizes, indices, values that are not finite), or "".
std::string check(const World& world);

/// Asserts check(world) == "" in debug builds; does nothing in release builds.
void assert_valid(const World& world);

/// Sums over all vertices: m v, kg m/s; m x cross v about the origin, kg m^2/s; m |v|, to which the
/// rounding of the first two is relative; m v^2 / 2, J.
Vec3 linear_momentum(const World& world);
Vec3 angular_momentum(const World& world);
double speed_sum(const World& world);
double kinetic_energy(const World& world);

/// FNV-1a of time, positions, velocities and history: equal for equal states.
std::uint64_t state_hash(const World& world);

/// Which object of a world.
struct ObjectId {
    ObjectKind kind = ObjectKind::Cloth;
    Index index = 0; ///< in World::cloths, solids, rigids or obstacles

    bool is_obstacle() const { return kind == ObjectKind::Obstacle; } ///< else it moves by forces
    auto operator<=>(const ObjectId&) const = default;
};

/// All objects of a world in their order.
std::vector<ObjectId> objects_of(const World& world);

const std::string& object_name(const World& world, ObjectId object);

/// Positions (m, at the world's time) and triangles of one object.
TriangleMesh object_mesh(const World& world, ObjectId object);

} // namespace weft
