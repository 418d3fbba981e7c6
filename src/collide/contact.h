#pragma once

#include "state/world.h"

#include <limits>
#include <memory>

namespace weft {

/// What contact did in one substep.
struct ContactReport {
    int contacts_obstacle = 0; ///< proximities and impacts between cloth and obstacles
    int contacts_self = 0;     ///< between cloth and cloth
    int impacts = 0;           ///< met by continuous detection
    int zones = 0;             ///< impact zones that impulses could not resolve
    int scaled_islands = 0;    ///< fail-safe: islands whose motion was cut back
    int unresolved = 0;        ///< pairs that cross, or would, after all stages
    double min_gap =
        std::numeric_limits<double>::infinity(); ///< least distance after, m; over pairs looked at
    double seconds_broad = 0.0, seconds_proximity = 0.0, seconds_impact = 0.0;
};

/// Two triangles that cross, by object and triangle number.
struct CrossingPair {
    std::string object_a, object_b;
    Index triangle_a, triangle_b;
    Vec3 place; ///< a point of both, m
};

/// Contact of all deformables with the obstacles and with each other. Keeps surfaces and trees
/// between calls; its results depend on the arguments alone, those of the constructor included:
/// make it of the world at t = 0, also for a run that goes on from a later state.
class ContactSolver {
public:
    ContactSolver(const World& world, const ContactParams& params);
    ~ContactSolver();
    ContactSolver(ContactSolver&&) noexcept;

    /// Changes average velocities so that moving linearly from world.positions over dt, while
    /// obstacles move from world.time to world.time + dt, touches nothing closer than allowed:
    /// proximities with friction, then continuous detection with impulses and impact zones.
    ///
    /// @param velocities #V average velocities v^{n+1/2}, m/s; those of vertices in `held` are kept
    /// @param held       #V flags: 1 = prescribed motion, infinite mass
    /// @param dt         s, > 0
    /// Source: Bridson et al. 2002; order of Bender and Deul 2013, section 3.
    ContactReport
    resolve(const World& world, std::span<Vec3> velocities, std::span<const char> held, double dt);

    /// One line for the user each: cloths whose mesh is finer than their contact thickness.
    const std::vector<std::string>& warnings() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// All pairs of crossing triangles at world.time where at least one is a deformable's, by the exact
/// discrete test; sorted. At most `limit` of them.
std::vector<CrossingPair> find_crossings(const World& world, std::size_t limit);

} // namespace weft
