#pragma once

#include "state/world.h"

#include <limits>
#include <memory>

namespace weft {

/// What is wrong with a pair that contact could not resolve.
enum class ProblemKind {
    Crossing, ///< its triangles cross
    TooNear,  ///< nearer than continuous detection allows
    Pinched,  ///< obstacles leave it no room
};

/// Two triangles that contact could not keep apart.
struct ContactProblem {
    std::array<Index, 2> objects;   ///< cloths, then obstacles, as in World
    std::array<Index, 2> triangles; ///< of these objects
    Vec3 place;                     ///< where they meet, m
    ProblemKind kind = ProblemKind::Crossing;
};

/// What contact did in one substep.
struct ContactReport {
    int contacts_obstacle = 0;              ///< proximities and impacts between cloth and obstacles
    int contacts_self = 0;                  ///< between cloth and cloth
    int impacts = 0;                        ///< met by continuous detection
    int zones = 0;                          ///< impact zones that impulses could not resolve
    int scaled_islands = 0;                 ///< fail-safe: islands whose motion was cut back
    int unresolved = 0;                     ///< pairs that cross, or would, after all stages
    std::vector<ContactProblem> problems{}; ///< these pairs, as far as they are known
    double min_gap =
        std::numeric_limits<double>::infinity(); ///< least distance after, m; over pairs looked at
    double seconds_broad = 0.0, seconds_proximity = 0.0, seconds_impact = 0.0;
};

/// A place where a deformable stands against an obstacle when a substep starts, so that the
/// implicit solve can carry it: between two sides whose relative motion is sum of weight * vertex
/// motion plus the obstacle's.
struct RestingContact {
    std::array<Index, 4> pair;     ///< which pair of the contact surface it is
    std::array<Index, 4> vertices; ///< of World; k_no_index where the obstacle stands
    std::array<double, 4> weights; ///< of the deformable's vertices; 0 elsewhere
    Vec3 obstacle_velocity;        ///< its share of the relative velocity, m/s
    Vec3 normal;                   ///< unit; the sides part along it
    double depth;                  ///< thickness - distance at the start, m
    double mass;                   ///< that a push along the normal moves, kg
    double friction;               ///< Coulomb
    double impulse = 0.0;          ///< that the solve carried along the normal, N s, >= 0
    Vec3 drag = Vec3::Zero();      ///< that it held across, N s
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

    /// Contacts of deformables with obstacles that stand now, in a fixed order; see RestingContact.
    void find_resting(const World& world,
                      std::span<const char> held,
                      double dt,
                      std::vector<RestingContact>& resting);

    /// Changes average velocities so that moving linearly from world.positions over dt, while
    /// obstacles move from world.time to world.time + dt, touches nothing closer than allowed:
    /// proximities with friction, then continuous detection with impulses and impact zones.
    ///
    /// @param velocities #V average velocities v^{n+1/2}, m/s; those of vertices in `held` are kept
    /// @param held       #V flags: 1 = prescribed motion, infinite mass
    /// @param dt         s, > 0
    /// @param resting    what the solve carried of find_resting's contacts: counts towards friction
    /// Source: Bridson et al. 2002; order of Bender and Deul 2013, section 3.
    ContactReport resolve(const World& world,
                          std::span<Vec3> velocities,
                          std::span<const char> held,
                          double dt,
                          std::span<const RestingContact> resting = {});

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
