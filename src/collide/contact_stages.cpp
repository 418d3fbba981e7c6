#include "collide/contact_stages.h"

#include "base/stopwatch.h"

namespace weft {

namespace {

/// Change of speed (m/s) at which rounds of impulses end.
constexpr double k_converged_speed = 1e-6;

/// Searches with impulses pair by pair, then searches with zones.
constexpr int k_impulse_passes = 4;
constexpr int k_zone_passes = 10;
constexpr int k_zone_sweeps = 40;

/// Rounds of the fail-safe; in the first, zones keep a part of their motion.
constexpr int k_soft_rounds = 6;
constexpr int k_failsafe_rounds = 64;

} // namespace

void ContactSolver::Impl::count_contact(const std::array<Index, 4>& vertices,
                                        ContactReport& report) const {
    const bool self = surface.is_deformable(vertices[0]) && surface.is_deformable(vertices[3]);
    ++(self ? report.contacts_self : report.contacts_obstacle);
}

/// What the solve carried is only kept from being pressed together again.
void ContactSolver::Impl::guard(std::span<const Contact> contacts,
                                double dt,
                                ContactReport& report) {
    guard_rows.clear();
    for (const Contact& contact : contacts) {
        guard_rows.push_back(guard_row(contact, dt));
        if (contact.impulse > 0.0 || contact.rest_gap < contact.thickness) {
            count_contact(contact.pair, report);
        }
    }
}

/// Impacts of the surface's motion as contacts; false: there are none.
bool ContactSolver::Impl::find_impacts(double dt, std::vector<Contact>& contacts) {
    if (!broad_phase.covers(surface, dt)) {
        find_candidates(dt);
    }
    const Stopwatch watch;
    look.assign(surface.start.size(), 1);
    impact_search.find(surface, candidates, look, dt, k_impulse_limit, impacts);
    for (const Impact& impact : impacts) {
        contacts.push_back(
            make_impact_contact(surface, candidates[at(impact.candidate)], impact.toi, dt));
    }
    clean_motion = impacts.empty();
    seconds_impact += watch.seconds();
    return !impacts.empty();
}

/// One search and what it asks for; false when nothing was found.
bool ContactSolver::Impl::pass_of_impulses(int pass, double dt, ContactReport& report) {
    if (!broad_phase.covers(surface, dt)) {
        find_candidates(dt);
    }
    const Stopwatch watch;
    impact_search.find(surface, candidates, look, dt, k_impulse_limit, impacts);
    report.impacts += static_cast<int>(impacts.size());
    std::fill(look.begin(), look.end(), 0);
    for (const Impact& impact : impacts) {
        const Candidate& candidate = candidates[at(impact.candidate)];
        impact_rows.push_back(make_impact_row(surface, candidate, impact.toi, dt));
        if (pass == 0) {
            count_contact(candidate.vertices, report);
        }
        for (const Index v : candidate.vertices) {
            look[at(v)] = 1;
        }
    }
    const bool in_zones = pass >= k_impulse_passes;
    if (pass == k_impulse_passes) {
        count_zones(report);
    }
    for (int i = 0; i < (in_zones ? k_zone_sweeps : 1) && !impacts.empty(); ++i) {
        // The guards again: an impulse must not press a third pair together.
        const double change =
            std::max(sweep(guard_rows, surface, look), sweep(impact_rows, surface, look));
        if (change < k_converged_speed) {
            break;
        }
    }
    report.seconds_impact += watch.seconds();
    return !impacts.empty();
}

void ContactSolver::Impl::count_zones(ContactReport& report) {
    zones.reset(surface);
    std::vector<char> seen(at(surface.deformable_vertices), 0);
    for (const Impact& impact : impacts) {
        zones.join(surface, candidates[at(impact.candidate)].vertices);
    }
    for (const Impact& impact : impacts) {
        for (const Index v : candidates[at(impact.candidate)].vertices) {
            if (surface.inverse_mass[at(v)] > 0.0 && !seen[at(zones.of(v))]) {
                seen[at(zones.of(v))] = 1;
                ++report.zones;
            }
        }
    }
}

int ContactSolver::Impl::resolve_impacts(double dt, ContactReport& report) {
    impact_rows.clear();
    solved_velocity = surface.velocity;
    std::fill(look.begin(), look.end(), 1);
    for (int pass = 0; pass < k_impulse_passes + k_zone_passes; ++pass) {
        if (!pass_of_impulses(pass, dt, report)) {
            return 0;
        }
    }
    return scale_zones(dt, report);
}

/// Accepts that pairs meet where obstacles leave them no space: the zones that still meet take back
/// the velocities of the solve, whose springs push from all sides, in place of those that impulses
/// gave them.
void ContactSolver::Impl::accept_unresolved() {
    std::vector<char> meets(at(surface.deformable_vertices), 0);
    for (const Impact& impact : impacts) {
        for (const Index v : candidates[at(impact.candidate)].vertices) {
            if (surface.inverse_mass[at(v)] > 0.0) {
                meets[at(zones.of(v))] = 1;
            }
        }
    }
    for (Index v = 0; v < surface.deformable_vertices; ++v) {
        if (meets[at(zones.of(v))]) {
            surface.velocity[at(v)] = solved_velocity[at(v)];
        }
    }
}

/// Zones in a jam can push each other on without end. Then their cloths stand still for this
/// substep, which meets nothing where obstacles and held vertices leave them space. False: those do
/// not, and all is as it was.
bool ContactSolver::Impl::stop_cloths(double dt) {
    const std::vector<Vec3> moving = surface.velocity;
    std::vector<char> stands(surface.objects.size(), 0);
    while (!impacts.empty()) {
        bool more = false;
        for (const Impact& impact : impacts) {
            for (const Index v : candidates[at(impact.candidate)].vertices) {
                char& stand = stands[at(surface.object_of_vertex[at(v)])];
                more = more || (surface.inverse_mass[at(v)] > 0.0 && !stand);
                stand = stand || surface.inverse_mass[at(v)] > 0.0;
            }
        }
        if (!more) {
            surface.velocity = moving;
            find_all_impacts(dt);
            return false;
        }
        for (Index v = 0; v < surface.deformable_vertices; ++v) {
            if (surface.inverse_mass[at(v)] > 0.0 && stands[at(surface.object_of_vertex[at(v)])]) {
                surface.velocity[at(v)].setZero();
            }
        }
        find_all_impacts(dt);
    }
    return true;
}

/// Impacts of the present motion, whatever was searched before.
void ContactSolver::Impl::find_all_impacts(double dt) {
    find_candidates(dt);
    look.assign(surface.start.size(), 1);
    impact_search.find(surface, candidates, look, dt, k_final_limit, impacts);
}

/// Scales down the motion of zones until nothing meets; returns the number of impacts left.
int ContactSolver::Impl::scale_zones(double dt, ContactReport& report) {
    zones.reset(surface);
    for (int round = 0;; ++round) {
        if (!broad_phase.covers(surface, dt)) {
            find_candidates(dt);
        }
        const Stopwatch watch;
        impact_search.find(surface, candidates, look, dt, k_final_limit, impacts);
        if (impacts.empty()) {
            return 0;
        }
        if (round == k_failsafe_rounds) {
            if (stop_cloths(dt)) {
                return 0;
            }
            accept_unresolved();
            return static_cast<int>(impacts.size());
        }
        std::fill(look.begin(), look.end(), 0);
        for (const Impact& impact : impacts) {
            zones.join(surface, candidates[at(impact.candidate)].vertices);
            for (const Index v : candidates[at(impact.candidate)].vertices) {
                look[at(v)] = 1;
            }
        }
        const double strength = round < k_soft_rounds ? 1.0 : 0.0;
        const int scaled = zones.scale_motion(surface, candidates, impacts, strength, dt, look);
        report.scaled_zones = std::max(report.scaled_zones, scaled);
        report.seconds_impact += watch.seconds();
    }
}

} // namespace weft
