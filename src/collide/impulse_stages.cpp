#include "base/stopwatch.h"
#include "collide/contact_stages.h"

namespace weft {

namespace {

/// Rounds over the proximities, at most, and the change of speed (m/s) at which they end.
constexpr int k_proximity_sweeps = 16;
constexpr double k_settled_speed = 1e-6;

/// Searches with impulses pair by pair, then searches with zones.
constexpr int k_impulse_passes = 4;
constexpr int k_zone_passes = 10;
constexpr int k_zone_sweeps = 40;

} // namespace

void ContactSolver::Impl::count_contact(const std::array<Index, 4>& vertices,
                                        ContactReport& report) const {
    const bool self = surface.is_deformable(vertices[0]) && surface.is_deformable(vertices[3]);
    ++(self ? report.contacts_self : report.contacts_obstacle);
}

void ContactSolver::Impl::settle_proximities(double dt, ContactReport& report) {
    const Stopwatch watch;
    proximity_search.find(surface, candidates, dt, proximities);
    for (int i = 0; i < k_proximity_sweeps; ++i) {
        if (sweep(proximities, surface, look) < k_settled_speed) {
            break;
        }
    }
    for (const ContactRow& row : proximities) {
        if (row.impulse > 0.0 || row.least_speed > 0.0) {
            count_contact(row.vertices, report);
        }
    }
    report.seconds_proximity += watch.seconds();
}

/// What the solve carried is only kept from being pressed together again.
void ContactSolver::Impl::guard(std::span<const Contact> contacts,
                                double dt,
                                ContactReport& report) {
    proximities.clear();
    for (const Contact& contact : contacts) {
        proximities.push_back(guard_row(contact, dt));
        if (contact.impulse > 0.0 || contact.rest < contact.thickness) {
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
    const bool zones = pass >= k_impulse_passes;
    if (pass == k_impulse_passes) {
        count_zones(report);
    }
    for (int i = 0; i < (zones ? k_zone_sweeps : 1) && !impacts.empty(); ++i) {
        // The proximities again: an impulse must not press a third pair together.
        const double change =
            std::max(sweep(proximities, surface, look), sweep(impact_rows, surface, look));
        if (change < k_settled_speed) {
            break;
        }
    }
    report.seconds_impact += watch.seconds();
    return !impacts.empty();
}

void ContactSolver::Impl::count_zones(ContactReport& report) {
    islands.reset(surface);
    std::vector<char> seen(at(surface.deformable_vertices), 0);
    for (const Impact& impact : impacts) {
        islands.join(surface, candidates[at(impact.candidate)].vertices);
    }
    for (const Impact& impact : impacts) {
        for (const Index v : candidates[at(impact.candidate)].vertices) {
            if (surface.inverse_mass[at(v)] > 0.0 && !seen[at(islands.of(v))]) {
                seen[at(islands.of(v))] = 1;
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
    return cut_back_rest(dt, report);
}

} // namespace weft
