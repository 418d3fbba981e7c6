#include "step/advance.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "collide/contact_solver.h"
#include "collide/crossings.h"
#include "collide/friction_history.h"
#include "remesh/adapt_world.h"
#include "state/attachment.h"
#include "step/constrained_vertices.h"
#include "step/implicit_step.h"
#include "step/recovery.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

/// Length of an automatic substep, s. Longer: implicit Euler damps folds away and one linearisation
/// overshoots; shorter: the time goes into substeps that change nothing visible.
constexpr double k_automatic_substep = 0.01;

/// A substep is halved at most this often: 1/1024 of its first length is the floor.
constexpr int k_most_halvings = 10;

/// A substep that contact cannot resolve is halved this often before it is accepted unresolved: a
/// pinch that leaves no room leaves none in shorter steps.
constexpr int k_contact_halvings = 3;

/// A vertex that leaves its object's mean motion by more than this fraction of the object's
/// diagonal in one substep has been thrown, not simulated.
constexpr double k_greatest_motion = 0.25;

/// Solves at most for pairs that meet during a substep. More: time spent on pairs that impulses
/// part as well; fewer: impulses, which know nothing of the cloth's stiffness, do more of the work.
constexpr int k_impact_solves = 4;

/// Time between adaptations of the meshes, s, in whole substeps; a frame where frames are shorter.
/// Longer: folds are there before the mesh that could show them; shorter: the same mesh, dearer.
constexpr double k_adaptation_interval = 0.02;

void add_contact(ContactReport& total, const ContactReport& substep) {
    total.contacts_obstacle = std::max(total.contacts_obstacle, substep.contacts_obstacle);
    total.contacts_self = std::max(total.contacts_self, substep.contacts_self);
    total.impacts += substep.impacts;
    total.zones += substep.zones;
    total.scaled_zones += substep.scaled_zones;
    total.unresolved = substep.unresolved;
    total.min_gap = std::min(total.min_gap, substep.min_gap);
}

void add_seconds(StageSeconds& total, const ImplicitReport& step, const ContactReport& contact) {
    total.forces += step.seconds_forces;
    total.assembly += step.seconds_assembly;
    total.solve += step.seconds_solve;
    total.contact_broad += contact.seconds_broad;
    total.contact_proximity += contact.seconds_proximity;
    total.contact_impact += contact.seconds_impact;
}

/// Does any of an object's vertices leave their mean motion too far?
bool moves_too_far(const World& world,
                   std::span<const Vec3> end_positions,
                   Index first_vertex,
                   Index vertex_count) {
    const auto first = static_cast<std::size_t>(first_vertex);
    const auto count = static_cast<std::size_t>(vertex_count);
    Eigen::AlignedBox3d box;
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = first; i < first + count; ++i) {
        box.extend(world.positions[i]);
        mean += end_positions[i] - world.positions[i];
    }
    mean /= static_cast<double>(count);
    const double limit = k_greatest_motion * box.diagonal().norm();
    for (std::size_t i = first; i < first + count; ++i) {
        if ((end_positions[i] - world.positions[i] - mean).norm() > limit) {
            return true;
        }
    }
    return false;
}

/// The same for each cloth and the particles of each solid. Rigid bodies may turn as they like.
bool moves_too_far(const World& world, std::span<const Vec3> end_positions) {
    bool moves = false;
    for (const Cloth& cloth : world.cloths) {
        moves =
            moves || moves_too_far(world, end_positions, cloth.first_vertex, cloth.vertex_count);
    }
    for (const Solid& solid : world.solids) {
        moves = moves || moves_too_far(world, end_positions, solid.body.first_particle,
                                       solid.body.particle_count);
    }
    return moves;
}

} // namespace

struct Stepper::Impl {
    explicit Impl(const Prepared& start)
        : scene(start.scene()), implicit(std::in_place, start.world(), scene),
          solver(start.world(), start.contact()), adaptation(start.world(), scene.gravity),
          start_positions(start.world()), contact_params(start.contact()),
          revisions(mesh_revisions(start.world())) {}

    bool substep(World& world, double dt, bool accept_unresolved, FrameReport& report);
    void find_average_velocities(const World& world, double dt);
    void solve_impacts(const World& world, double dt, ImplicitReport& step);
    void finish(World& world, double dt);
    void verify(const World& world, double time, FrameReport& report);
    void conserve_angular_momentum(World& world) const;
    void drop_history_of_new_contacts(World& world, double dt) const;
    void adapt(World& world, double time, FrameReport& report);
    void remesh(const World& world);

    SceneParams scene;
    std::optional<ImplicitStep> implicit;
    ContactSolver solver;
    WorldAdaptation adaptation;
    StartPositions start_positions;
    std::optional<WorldCrossings> crossings; ///< made when asked for
    ContactParams contact_params;
    std::vector<Index> revisions; ///< revision of each cloth's mesh that the solvers follow
    std::vector<ClothChanges> changes;
    ConstrainedVertices constrained;
    std::vector<Contact> contacts, met;
    std::vector<Vec3> end_positions, end_velocities;       ///< as if nothing touched
    std::vector<Vec3> average_velocities, free_velocities; ///< with and without contact
};

/// One substep in the order of Bender and Deul 2013, section 3. False: it failed, nothing changed.
/// @param accept_unresolved  whether the substep may end with pairs that contact could not part
bool Stepper::Impl::substep(World& world, double dt, bool accept_unresolved, FrameReport& report) {
    // 1. external forces, 2. one implicit step of all deformables, 3. average velocities, and
    // 4. proximities with friction, which act inside the step
    find_constrained(world, world.time + dt, constrained);
    solver.find_contacts(world, constrained.flags, dt, contacts);
    ImplicitReport step =
        implicit->solve(world, constrained, dt, end_positions, end_velocities, contacts);
    find_average_velocities(world, dt);
    solve_impacts(world, dt, step);
    report.cg_iterations += step.cg_iterations;
    if (!step.converged || moves_too_far(world, end_positions)) {
        return false;
    }
    report.residual = std::max(report.residual, step.residual);

    // 5. impacts that are left, until there is none
    average_velocities = free_velocities;
    const ContactReport contact =
        solver.resolve(world, average_velocities, constrained.flags, dt, contacts);
    if (contact.unresolved > 0 && contact.was_clean && !accept_unresolved) {
        return false;
    }
    add_contact(report.contact, contact);
    add_unresolved(report.problems, world.time + dt, contact.pairs);
    report.substeps_impacts += contact.impacts > 0;
    report.substeps_zones += contact.zones > 0;
    report.substeps_scaled += contact.scaled_zones > 0;
    add_seconds(report.seconds, step, contact);

    // 6. final positions and velocities
    finish(world, dt);
    update_attachments(world, world.time + dt);
    assert_valid(world);
    verify(world, world.time + dt, report);
    return true;
}

/// 7. adapt the mesh: to what has just been reached.
void Stepper::Impl::adapt(World& world, double time, FrameReport& report) {
    const ScopedTime watch(report.seconds.adapt);
    const AdaptationReport done = adaptation.adapt(world, time, solver, changes);
    revisions = mesh_revisions(world);
    report.refined += done.refined;
    report.coarsened += done.coarsened;
    report.adaptation_energy += done.energy;
    if (!done.changed) {
        return;
    }
    {
        const ScopedTime update_watch(report.seconds.matrix_update);
        implicit->remesh(world, changes);
    }
    solver.remesh(world, start_positions.of(world));
    assert_valid(world);
    verify(world, time, report);
}

/// Follows a world whose mesh others have changed: it was resumed, or taken back to a frame.
void Stepper::Impl::remesh(const World& world) {
    if (revisions == mesh_revisions(world)) {
        return;
    }
    revisions = mesh_revisions(world);
    implicit.emplace(world, scene);
    solver.remesh(world, start_positions.of(world));
    adaptation.remesh(world);
}

/// Looks for crossings by a search that shares nothing with contact, which it checks.
void Stepper::Impl::verify(const World& world, double time, FrameReport& report) {
    if (!crossings) {
        return;
    }
    const ScopedTime watch(report.seconds.verify);
    const std::vector<UnresolvedPair> found = crossings->find(world, time);
    report.crossings = std::max(report.crossings, static_cast<int>(found.size()));
    add_unresolved(report.problems, time, found);
}

void Stepper::Impl::find_average_velocities(const World& world, double dt) {
    free_velocities.resize(world.vertex_count());
    parallel_for(world.vertex_count(), [&](std::size_t i) {
        free_velocities[i] = (end_positions[i] - world.positions[i]) / dt;
    });
}

/// Pairs that the step lets meet are given to it as contacts, so that what they carry spreads
/// through the cloth as all its forces do. What meets after that is left to impulses.
void Stepper::Impl::solve_impacts(const World& world, double dt, ImplicitReport& step) {
    for (int pass = 0; step.converged; ++pass) {
        met.clear();
        if (!solver.find_impacts(world, free_velocities, constrained.flags, dt, met) ||
            pass == k_impact_solves) {
            return;
        }
        contacts.insert(contacts.end(), met.begin(), met.end());
        implicit->solve_again(world, constrained, end_positions, end_velocities, contacts, step);
        find_average_velocities(world, dt);
    }
}

/// Takes the motion that contact left. A vertex that nothing touched keeps the integrator's result;
/// one that was touched moves with its average velocity and restarts its two-step history so that
/// the next step treats it as implicit Euler would. BDF2 ends with a velocity that is not the
/// average one, so that contact under it changes the momentum of two cloths a little; but keeping
/// the difference makes cloth that rests in contact gain energy until it is thrown off.
void Stepper::Impl::finish(World& world, double dt) {
    const bool two_step = scene.integrator == Integrator::Bdf2;
    parallel_for(world.vertex_count(), [&](std::size_t i) {
        if (average_velocities[i] != free_velocities[i]) {
            end_positions[i] = world.positions[i] + dt * average_velocities[i];
        }
    });
    remember(contacts, world.positions, end_positions, world.friction_history);
    parallel_for(world.vertex_count(), [&](std::size_t i) {
        const Vec3 x = world.positions[i];
        const Vec3 v = world.velocities[i];
        Vec3 previous_x = x;
        Vec3 previous_v = v;
        if (average_velocities[i] == free_velocities[i]) {
            world.positions[i] = end_positions[i];
            world.velocities[i] = end_velocities[i];
        } else {
            const Vec3 step_change = end_velocities[i] - v; // acceleration times dt, before contact
            world.positions[i] = end_positions[i];
            world.velocities[i] = average_velocities[i];
            previous_v = world.velocities[i] - step_change;
            previous_x = world.positions[i] - dt * world.velocities[i] - dt * step_change;
        }
        if (two_step) {
            world.previous_positions[i] = previous_x;
            world.previous_velocities[i] = previous_v;
        }
    });
    conserve_angular_momentum(world);
    interpolate_embedded(world, world.positions);
    interpolate_embedded(world, world.velocities);
    if (two_step) {
        drop_history_of_new_contacts(world, dt);
    }
    world.history_dt = two_step ? dt : 0.0;
}

/// A turning body ends with the velocity of the solve: its average one belongs to a chord of its
/// path, and would lose angular momentum.
void Stepper::Impl::conserve_angular_momentum(World& world) const {
    for (const RigidBody& rigid : world.rigids) {
        const auto first = static_cast<std::size_t>(rigid.body.first_particle);
        for (std::size_t i = first; i < first + 4; ++i) {
            world.velocities[i] = end_velocities[i] + (average_velocities[i] - free_velocities[i]);
        }
    }
}

/// Takes the velocity that an obstacle took from a vertex within the implicit solve out of its
/// two-step history too, which would otherwise throw the vertex back with a third of its speed. A
/// vertex that only rests keeps its history.
void Stepper::Impl::drop_history_of_new_contacts(World& world, double dt) const {
    // the solve itself moved an untouched vertex by 2 dt / 3 of the velocity taken, or by all of it
    const double untouched_shift = world.history_dt == dt ? -dt / 3.0 : 0.0;
    for (const Contact& contact : contacts) {
        const bool with_obstacle = std::find(contact.vertices.begin(), contact.vertices.end(),
                                             k_no_index) != contact.vertices.end();
        if (!with_obstacle || contact.impulse <= 0.0) {
            continue;
        }
        for (std::size_t k = 0; k < 4; ++k) {
            if (contact.vertices[k] == k_no_index || contact.weights[k] == 0.0) {
                continue;
            }
            const auto i = static_cast<std::size_t>(contact.vertices[k]);
            const Vec3 outward = contact.weights[k] > 0.0 ? contact.normal : -contact.normal;
            const double parting = outward.dot(world.previous_velocities[i]) +
                                   contact.normal.dot(contact.obstacle_displacement) / dt;
            if (constrained.flags[i] == 0 && parting < 0.0) {
                const bool touched = average_velocities[i] != free_velocities[i];
                const Vec3 taken = -parting * outward;
                world.previous_velocities[i] += taken;
                world.previous_positions[i] += (touched ? dt : untouched_shift) * taken;
            }
        }
    }
}

Stepper::Stepper(const Prepared& start) : impl_(std::make_unique<Impl>(start)) {}
Stepper::~Stepper() = default;
Stepper::Stepper(Stepper&&) noexcept = default;

void Stepper::verify_substeps(const World& world) {
    impl_->crossings.emplace(world, impl_->contact_params.self);
}

std::optional<FrameReport> Stepper::advance_frame(World& world,
                                                  const std::function<bool()>& should_stop) {
    impl_->remesh(world);
    const Snapshot start(world);
    const double frame_dt = 1.0 / impl_->scene.fps;
    const int base_substeps =
        impl_->scene.substeps > 0
            ? impl_->scene.substeps
            : static_cast<int>(std::ceil(frame_dt / k_automatic_substep - 1e-9));
    const double frame_start = (world.frame - 1) / impl_->scene.fps;
    const std::int64_t ticks_per_substep = std::int64_t{1} << k_most_halvings;
    const std::int64_t end = base_substeps * ticks_per_substep;
    const std::int64_t adaptation_ticks =
        ticks_per_substep *
        std::clamp(std::lround(k_adaptation_interval * base_substeps / frame_dt), 1L,
                   static_cast<long>(base_substeps));

    FrameReport report;
    int halvings = 0;
    for (std::int64_t tick = 0; tick < end;) {
        if (should_stop && should_stop()) {
            start.restore(world);
            return std::nullopt;
        }
        const std::int64_t length = ticks_per_substep >> halvings;
        const double dt = std::ldexp(frame_dt / base_substeps, -halvings);
        world.time = frame_start + frame_dt * static_cast<double>(tick) / static_cast<double>(end);
        if (impl_->substep(world, dt, halvings >= k_contact_halvings, report)) {
            tick += length;
            if (tick % adaptation_ticks == 0) {
                impl_->adapt(world, world.time + dt, report);
            }
            ++report.substeps;
            if (halvings > 0 && tick % (2 * length) == 0) {
                --halvings; // only where the longer substep starts on its own grid
            }
        } else if (++report.retries; halvings++ == k_most_halvings) {
            throw Error(
                ExitCode::Diverged,
                fmt::format("frame {}: no substep down to {:.3g} s converges at t = {:.6g} s; "
                            "softer material, more substeps or slower motion may help",
                            world.frame + 1, dt, world.time));
        }
    }
    keep_last_of_each(report.problems);
    ++world.frame;
    world.time = (world.frame - 1) / impl_->scene.fps;
    if (report.contact.unresolved > 0 && recover_from_crossings(world)) {
        report.contact.unresolved = 0;
    }
    return report;
}

} // namespace weft
