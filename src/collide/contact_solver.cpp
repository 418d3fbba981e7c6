#include "base/parallel.h"
#include "base/stopwatch.h"
#include "collide/contact_stages.h"

namespace weft {

namespace {

/// Equal but for what rounding does to a sum (obstacles come from their poses anew).
bool same_places(std::span<const Vec3> a, std::span<const Vec3> b) {
    return a.size() == b.size() &&
           parallel_reduce(
               a.size(), true, [&](std::size_t i) { return (a[i] - b[i]).squaredNorm() < 1e-24; },
               [](bool p, bool q) { return p && q; });
}

} // namespace

ContactSolver::Impl::Impl(const World& world, const ContactParams& contact)
    : params(contact), surface(make_surface(world, contact)), broad_phase(surface, meets_self()),
      crossing_search(surface, meets_self()) {}

void ContactSolver::Impl::find_candidates(double dt) {
    const Stopwatch watch;
    broad_phase.find(surface, dt, candidates);
    seconds_broad += watch.seconds();
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
    for (const auto* rows : {&guard_rows, &impact_rows}) {
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
            report.pairs = describe_unresolved(surface, candidates, impacts, ends);
        }
        for (const auto& pair : crossings) {
            report.pairs.push_back(describe_crossing(surface, ends, pair));
        }
    }
    if (report.unresolved == 0) {
        clean_start = surface.start;
        clean_end = ends;
    }
}

ContactReport ContactSolver::Impl::resolve(double dt, std::span<const Contact> contacts) {
    ContactReport report;
    look.assign(surface.start.size(), 0);
    const bool clean_before = is_clean_start();
    report.was_clean = clean_before;
    guard(contacts, dt, report);
    const int left = clean_motion ? 0 : resolve_impacts(dt, report);
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
    impl_->contact_search.find(impl_->surface, impl_->candidates, world.friction_history, dt,
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
                                     std::span<const Contact> contacts) {
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
