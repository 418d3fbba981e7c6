#include "base/parallel.h"
#include "base/stopwatch.h"
#include "collide/contact_search.h"
#include "collide/crossings.h"
#include "collide/impact.h"
#include "collide/islands.h"
#include "collide/left_pairs.h"
#include "collide/proximity.h"

#include <fmt/core.h>

#include <cassert>

// The stages of one substep, methods of Bridson et al. 2002, Harmon et al. 2008 and Provot 1997:
//
// 1. pairs that are near or meet are carried by the implicit solve (contact_search.h); without it
//    proximities are set right with friction, at the start positions, to convergence;
// 2. impacts of the straight motion: impulses pair by pair, all impacts so far in each round;
// 3. zones: what is still met is solved together with the pairs of 1, until it fits;
// 4. islands that still do not fit are cut back (islands.h), which ends.
//
// Whatever is accepted was tested: no candidate that a vertex of changed velocity belongs to is
// left out of the last search. The search keeps a smaller distance in stage 4 than before it, so
// that rounding at the limit does not send resting pairs there.

namespace weft {

namespace {

constexpr ImpactLimit k_impulse_limit{.thickness_share = 0.3, .start_share = 0.8};
constexpr ImpactLimit k_final_limit{.thickness_share = 0.1, .start_share = 0.5};

/// Rounds over the proximities, at most, and the change of speed (m/s) at which they end.
constexpr int k_proximity_sweeps = 16;
constexpr double k_settled_speed = 1e-6;

/// Searches with impulses pair by pair, then searches with zones.
constexpr int k_impulse_passes = 4;
constexpr int k_zone_passes = 10;
constexpr int k_zone_sweeps = 40;

/// Rounds of the last resort: in the first, islands keep a part of their motion.
constexpr int k_soft_cuts = 6;
constexpr int k_cuts = 64;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// Equal but for what rounding does to a sum (obstacles come from their poses anew).
bool same_places(std::span<const Vec3> a, std::span<const Vec3> b) {
    return a.size() == b.size() &&
           parallel_reduce(
               a.size(), true, [&](std::size_t i) { return (a[i] - b[i]).squaredNorm() < 1e-24; },
               [](bool p, bool q) { return p && q; });
}

} // namespace

struct ContactSolver::Impl {
    ContactParams params;
    ContactSurface surface;
    BroadPhase broad_phase;
    ContactSearch contact_search;
    ProximitySearch proximity_search;
    ImpactSearch impact_search;
    CrossingSearch crossing_search;
    Islands islands;
    std::vector<std::string> warnings;

    std::vector<Candidate> candidates;
    std::vector<ContactRow> proximities, impact_rows;
    std::vector<Impact> impacts;
    std::vector<char> look;            ///< #V of the surface: changed since the last search
    std::vector<Vec3> solved_velocity; ///< #V of the surface: before impulses
    std::vector<Vec3> ends;            ///< #V of the surface: positions after the substep

    /// Positions (all of the surface) that are known to be free of crossings: before and after the
    /// last substep.
    std::vector<Vec3> clean_start, clean_end;

    bool clean_motion = false; ///< the surface's motion was searched and meets nothing
    double seconds_broad = 0.0, seconds_proximity = 0.0, seconds_impact = 0.0; ///< of the substep

    Impl(const World& world, const ContactParams& contact)
        : params(contact), surface(make_surface(world, contact)),
          broad_phase(surface, meets_self()), crossing_search(surface, meets_self()) {
        for (const ContactObject& object : surface.objects) {
            if (contact.self && object.least_thickness < object.thickness) {
                warnings.push_back(fmt::format(
                    "{}: contact thickness {:g} m is coarse for some of its triangles; down to "
                    "{:.3g} m is used there between cloth and cloth",
                    object.name, object.thickness, object.least_thickness));
            }
        }
    }

    /// Whether what moves by forces is looked at against itself: bodies always are.
    bool meets_self() const { return params.self || !surface.bodies.empty(); }

    ContactReport resolve(double dt, std::optional<std::span<const Contact>> contacts);
    void find_candidates(double dt);
    void settle_proximities(double dt, ContactReport& report);
    void guard(std::span<const Contact> contacts, double dt, ContactReport& report);
    bool find_impacts(double dt, std::vector<Contact>& contacts);
    int resolve_impacts(double dt, ContactReport& report);
    bool pass_of_impulses(int pass, double dt, ContactReport& report);
    int cut_back_rest(double dt, ContactReport& report);
    bool stop_cloths(double dt);
    void find_all_impacts(double dt);
    void yield();
    void count_zones(ContactReport& report);
    void measure_end(double dt, bool clean_before, int left, ContactReport& report);
    bool is_clean_start();
    void count_contact(const std::array<Index, 4>& vertices, ContactReport& report) const;
};

void ContactSolver::Impl::find_candidates(double dt) {
    const Stopwatch watch;
    broad_phase.find(surface, dt, candidates);
    seconds_broad += watch.seconds();
}

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

/// Where obstacles leave no room, contact gives way: the islands that still meet go on as they came
/// from the solve, whose springs push from all sides, rather than with what impulses made of it.
void ContactSolver::Impl::yield() {
    std::vector<char> meets(at(surface.deformable_vertices), 0);
    for (const Impact& impact : impacts) {
        for (const Index v : candidates[at(impact.candidate)].vertices) {
            if (surface.inverse_mass[at(v)] > 0.0) {
                meets[at(islands.of(v))] = 1;
            }
        }
    }
    for (Index v = 0; v < surface.deformable_vertices; ++v) {
        if (meets[at(islands.of(v))]) {
            surface.velocity[at(v)] = solved_velocity[at(v)];
        }
    }
}

/// Islands in a jam can push each other on without end. Then the cloths that they are of stand
/// still for this substep, which meets nothing where obstacles and held vertices leave them room.
/// False: they do not, and all is as it was.
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

/// Cuts back islands until nothing is met; returns the impacts that are left.
int ContactSolver::Impl::cut_back_rest(double dt, ContactReport& report) {
    islands.reset(surface);
    for (int round = 0;; ++round) {
        if (!broad_phase.covers(surface, dt)) {
            find_candidates(dt);
        }
        const Stopwatch watch;
        impact_search.find(surface, candidates, look, dt, k_final_limit, impacts);
        if (impacts.empty()) {
            return 0;
        }
        if (round == k_cuts) {
            if (stop_cloths(dt)) {
                return 0;
            }
            yield();
            return static_cast<int>(impacts.size());
        }
        std::fill(look.begin(), look.end(), 0);
        for (const Impact& impact : impacts) {
            islands.join(surface, candidates[at(impact.candidate)].vertices);
            for (const Index v : candidates[at(impact.candidate)].vertices) {
                look[at(v)] = 1;
            }
        }
        const int cut = cut_back(surface, candidates, impacts, islands,
                                 round < k_soft_cuts ? 1.0 : 0.0, dt, look);
        report.scaled_islands = std::max(report.scaled_islands, cut);
        report.seconds_impact += watch.seconds();
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

/// Exact, but only asked when the positions are not those that the last substep ended or began
/// with.
bool ContactSolver::Impl::is_clean_start() {
    return same_places(surface.start, clean_end) || same_places(surface.start, clean_start) ||
           crossing_search.find(surface, surface.start).empty();
}

void ContactSolver::Impl::measure_end(double dt,
                                      bool clean_before,
                                      int left,
                                      ContactReport& report) {
    ends.resize(surface.start.size());
    parallel_for(ends.size(),
                 [&](std::size_t i) { ends[i] = surface.start[i] + dt * surface.velocity[i]; });
    const auto gap = [&](const ContactRow& row) {
        PairPoints x;
        for (std::size_t i = 0; i < 4; ++i) {
            x[i] = ends[at(row.vertices[i])];
        }
        return separation(row.kind, x).distance;
    };
    for (const auto* rows : {&proximities, &impact_rows}) {
        report.min_gap =
            std::min(report.min_gap, parallel_reduce(
                                         rows->size(), report.min_gap,
                                         [&](std::size_t i) { return gap((*rows)[i]); },
                                         [](double a, double b) { return std::min(a, b); }));
    }
    const bool clean = clean_before && left == 0;
    if (!clean) {
        const auto crossings = crossing_search.find(surface, ends);
        report.unresolved = std::max(left, static_cast<int>(crossings.size()));
        if (left > 0) {
            report.problems = describe_left(surface, candidates, impacts, ends);
        }
        for (const auto& pair : crossings) {
            report.problems.push_back(describe_crossing(surface, ends, pair));
        }
    }
    if (report.unresolved == 0) {
        clean_start = surface.start;
        clean_end = ends;
    }
}

ContactReport ContactSolver::Impl::resolve(double dt,
                                           std::optional<std::span<const Contact>> contacts) {
    ContactReport report;
    look.assign(surface.start.size(), 0);
    const bool clean_before = is_clean_start();
    report.was_clean = clean_before;
    if (contacts) {
        guard(*contacts, dt, report);
    } else {
        find_candidates(dt);
        settle_proximities(dt, report);
    }
    const int left = contacts && clean_motion ? 0 : resolve_impacts(dt, report);
    measure_end(dt, clean_before, left, report);
    report.seconds_broad += std::exchange(seconds_broad, 0.0);
    report.seconds_proximity += std::exchange(seconds_proximity, 0.0);
    report.seconds_impact += std::exchange(seconds_impact, 0.0);
    return report;
}

/// The trees keep the shape of their first boxes, and the order of contacts follows from it. They
/// are made here so that the world given now decides, not the one that happens to be resolved first
/// (a resumed run begins in its middle).
ContactSolver::ContactSolver(const World& world, const ContactParams& params)
    : impl_(std::make_unique<Impl>(world, params)) {
    const std::vector<Vec3> still(world.vertex_count(), Vec3::Zero());
    const std::vector<char> held(world.vertex_count(), 0);
    place_surface(impl_->surface, world, still, held, 1.0);
    impl_->broad_phase.remesh(impl_->surface, world.positions);
    impl_->broad_phase.find(impl_->surface, 0.0, impl_->candidates);
}
ContactSolver::~ContactSolver() = default;
ContactSolver::ContactSolver(ContactSolver&&) noexcept = default;

std::optional<EditGuard> ContactSolver::guard_edits() const {
    if (!impl_->params.enabled) {
        return std::nullopt;
    }
    return EditGuard(impl_->surface, impl_->broad_phase, impl_->ends);
}

/// What is known to be free of crossings stays so: the edits were guarded.
void ContactSolver::remesh(const World& world, std::span<const Vec3> start) {
    Impl& impl = *impl_;
    const auto old_count = static_cast<long>(impl.surface.deformable_vertices);
    impl.surface = make_surface(world, impl.params);
    impl.broad_phase.remesh(impl.surface, start);
    impl.crossing_search = CrossingSearch(impl.surface, impl.meets_self());
    impl.clean_start.clear();
    if (!impl.clean_end.empty()) {
        impl.clean_end.erase(impl.clean_end.begin(), impl.clean_end.begin() + old_count);
        impl.clean_end.insert(impl.clean_end.begin(), world.positions.begin(),
                              world.positions.end());
    }
}

const std::vector<std::string>& ContactSolver::warnings() const {
    return impl_->warnings;
}

void ContactSolver::find_contacts(const World& world,
                                  std::span<const char> held,
                                  double dt,
                                  std::vector<Contact>& contacts) {
    contacts.clear();
    if (!impl_->params.enabled) {
        return;
    }
    place_surface(impl_->surface, world, world.velocities, held, dt);
    impl_->find_candidates(dt);
    impl_->clean_motion = false;
    const Stopwatch watch;
    impl_->contact_search.find(impl_->surface, impl_->candidates, world.contact_memory, dt,
                               contacts);
    impl_->seconds_proximity += watch.seconds();
}

bool ContactSolver::find_impacts(const World& world,
                                 std::span<const Vec3> velocities,
                                 std::span<const char> held,
                                 double dt,
                                 std::vector<Contact>& contacts) {
    if (!impl_->params.enabled) {
        return false;
    }
    place_surface(impl_->surface, world, velocities, held, dt);
    return impl_->find_impacts(dt, contacts);
}

ContactReport ContactSolver::resolve(const World& world,
                                     std::span<Vec3> velocities,
                                     std::span<const char> held,
                                     double dt,
                                     std::optional<std::span<const Contact>> contacts) {
    if (!impl_->params.enabled) {
        return {};
    }
    ContactSurface& surface = impl_->surface;
    place_surface(surface, world, velocities, held, dt);
    const ContactReport report = impl_->resolve(dt, contacts);
    for (std::size_t i = 0; i < velocities.size(); ++i) {
        if (!held[i]) {
            velocities[i] = surface.velocity[i];
        }
    }
    return report;
}

} // namespace weft
