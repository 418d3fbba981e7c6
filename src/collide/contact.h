#pragma once

#include "collide/edit_guard.h"
#include "geometry/separation.h"
#include "state/world.h"

#include <limits>
#include <memory>
#include <optional>

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
    int impacts = 0;                        ///< met by continuous detection after the solve
    int zones = 0;                          ///< impact zones that impulses could not resolve
    int scaled_islands = 0;                 ///< fail-safe: islands whose motion was cut back
    bool was_clean = true;                  ///< nothing crossed when the substep started
    int unresolved = 0;                     ///< pairs that cross, or would, after all stages
    std::vector<ContactProblem> problems{}; ///< these pairs, as far as they are known
    double min_gap =
        std::numeric_limits<double>::infinity(); ///< least distance after, m; over pairs looked at
    double seconds_broad = 0.0, seconds_proximity = 0.0, seconds_impact = 0.0;
};

/// Speed (m/s) above which friction is kinetic: below it contacts settle and share their load, by
/// way of slips too small to count as sliding (Stribeck's curve as a step).
inline constexpr double k_sliding_speed = 1e-3;

/// A pair that is near when a substep starts, or meets during it, so that the implicit solve can
/// carry it. The relative displacement of its sides over the substep is the sum of weight times
/// vertex displacement plus `driven`.
struct Contact {
    std::array<Index, 4> pair; ///< which pair of the contact surface it is
    PairKind kind;
    std::array<Index, 4> vertices; ///< of World; k_no_index where an obstacle stands
    std::array<double, 4> weights; ///< as in Separation
    Vec3 normal;                   ///< unit; the sides part along it
    double gap;                    ///< between the sides along the normal, at the start, m
    double thickness;              ///< wanted gap, m
    double rest;                   ///< gap from which on nothing pushes, m
    double room;                   ///< by which pushing sides may come nearer than `rest`, m
    double mass;                   ///< that a push along the normal moves, kg
    double friction;               ///< Coulomb's, while it slides
    double static_friction;        ///< while it sticks
    Vec3 driven;                   ///< the obstacle's share of the displacement, m
    Vec3 slip = Vec3::Zero();      ///< across, from where friction is free, at the start; then,
                                   ///< once reported, at the end, m
    bool slides = false;
    bool met = false;         ///< found by continuous detection, not near at the start
    double impulse = 0.0;     ///< that the solve carried along the normal, N s, >= 0
    Vec3 drag = Vec3::Zero(); ///< that it held across, N s
};

/// The memory that contacts leave, sorted.
/// @param start, end #V of World: where the substep began and ended, m
void remember(std::span<const Contact> contacts,
              std::span<const Vec3> start,
              std::span<const Vec3> end,
              std::vector<ContactMemory>& memory);

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

    /// Starts the substep from world.time to world.time + dt: the pairs that are near now, in a
    /// fixed order, each with what world.contact_memory knows of it.
    /// @param held #V flags: 1 = prescribed motion, infinite mass
    void find_contacts(const World& world,
                       std::span<const char> held,
                       double dt,
                       std::vector<Contact>& contacts);

    /// Appends the pairs that meet, or that contacts as they stand do not keep apart, when vertices
    /// move linearly from world.positions with `velocities` (#V, m/s). False: there are none.
    bool find_impacts(const World& world,
                      std::span<const Vec3> velocities,
                      std::span<const char> held,
                      double dt,
                      std::vector<Contact>& contacts);

    /// Changes average velocities so that moving linearly from world.positions over dt, while
    /// obstacles move from world.time to world.time + dt, touches nothing closer than allowed:
    /// continuous detection with impulses, impact zones, and islands that are cut back.
    ///
    /// @param velocities #V average velocities v^{n+1/2}, m/s; those of vertices in `held` are kept
    /// @param contacts   what the solve carried, whose motion find_impacts saw last; given none,
    /// pairs that are near are first set right
    ///                   by impulses with friction
    /// Source: Bridson et al. 2002; order of Bender and Deul 2013, section 3.
    ContactReport resolve(const World& world,
                          std::span<Vec3> velocities,
                          std::span<const char> held,
                          double dt,
                          std::optional<std::span<const Contact>> contacts = {});

    /// From here until the world's mesh changes: which edits of it leave contact as the last
    /// resolve() left it. None: contact is off.
    std::optional<EditGuard> guard_edits() const;

    /// Takes up the world's changed mesh. Later results are those of a solver that never knew
    /// another one.
    /// @param start  #V of World, where vertices were at t = 0, m: see BroadPhase::remesh
    void remesh(const World& world, std::span<const Vec3> start);

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
