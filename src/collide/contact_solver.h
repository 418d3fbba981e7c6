#pragma once

#include "collide/contact.h"
#include "collide/contact_report.h"
#include "collide/edit_guard.h"
#include "state/world.h"

#include <memory>
#include <optional>

namespace weft {

/// Contact of all deformables with the obstacles and with each other. Keeps surfaces and trees
/// between calls; its results depend on the arguments alone, those of the constructor included:
/// make it of the world at t = 0, also for a run that goes on from a later state.
class ContactSolver {
public:
    ContactSolver(const World& world, const ContactParams& params);
    ~ContactSolver();
    ContactSolver(ContactSolver&&) noexcept;

    /// Starts the substep from world.time to world.time + dt: the pairs that are near now, in a
    /// fixed order, each with what world.friction_history knows of it.
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
    /// continuous detection with impulses, impact zones, and zones whose motion is scaled down.
    ///
    /// @param velocities #V average velocities v^{n+1/2}, m/s; those of vertices in `held` are kept
    /// @param contacts   what the solve carried, whose motion find_impacts() saw last
    /// Source: Bridson et al. 2002; order of Bender and Deul 2013, section 3.
    ContactReport resolve(const World& world,
                          std::span<Vec3> velocities,
                          std::span<const char> held,
                          double dt,
                          std::span<const Contact> contacts);

    /// From here until the world's mesh changes: which edits of it leave contact as the last
    /// resolve() left it. None: contact is off.
    std::optional<EditGuard> guard_edits() const;

    /// Takes up the world's changed mesh. Later results are those of a solver that never knew
    /// another one.
    /// @param start  #V of World, where vertices were at t = 0, m: see BroadPhase::remesh
    void remesh(const World& world, std::span<const Vec3> start);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace weft
