#include "collide/contact_search.h"
#include "collide/contact_solver.h"
#include "support/contact_world.h"

#include <benchmark/benchmark.h>

// The stages of contact on a sheet of 64 x 64 cells, 1 m, laid over a sphere of 0.3 m with its rim
// hanging in nine folds, at rest but for one substep of gravity.

namespace weft {

namespace {

constexpr double k_dt = 0.005; // s

struct Draped {
    World world;
    std::vector<Vec3> velocities; ///< of the last substep, gravity applied, before contact
    std::vector<char> held;
};

/// Where the point at polar coordinates (s, angle) of the sheet lies.
Vec3 draped_place(double s, double angle) {
    const double radius = 0.3 + 2e-3;
    const double turn = std::acos(0.0);
    const double hanging = std::max(0.0, s - turn * radius);
    const double polar = std::min(s / radius, turn);
    const double out = radius * std::sin(polar) + 0.4 * hanging * (1.0 + std::cos(9.0 * angle));
    return {out * std::cos(angle), radius * std::cos(polar) - hanging, out * std::sin(angle)};
}

const Draped& draped() {
    static const Draped state = [] {
        Draped made;
        FabricParams fabric;
        fabric.thickness = 2e-3;
        test::add_sheet(made.world, 64, 1.0, 0.0, fabric);
        test::add_sphere(made.world, 0.3, Vec3::Zero(), 4);
        for (Vec3& x : made.world.positions) {
            x = draped_place(x.norm(), std::atan2(x.z(), x.x()));
        }
        made.velocities.assign(made.world.vertex_count(), Vec3(0.0, -9.81 * k_dt, 0.0));
        made.held.assign(made.world.vertex_count(), 0);
        return made;
    }();
    return state;
}

ContactSurface placed_surface() {
    ContactSurface surface = make_surface(draped().world);
    place_surface(surface, draped().world, draped().velocities, draped().held, k_dt);
    return surface;
}

std::vector<Candidate> candidates_of(const ContactSurface& surface) {
    BroadPhase broad_phase(surface, true);
    std::vector<Candidate> candidates;
    broad_phase.find(surface, k_dt, candidates);
    return candidates;
}

void Refit(benchmark::State& state) {
    const World& world = draped().world;
    std::vector<Box> boxes;
    for (const Triangle& t : world.cloths[0].triangles) {
        const auto x = [&](std::size_t k) {
            return world.positions[static_cast<std::size_t>(t[k])];
        };
        boxes.push_back(unite(segment_box(x(0), x(1), 1e-3), segment_box(x(2), x(2), 1e-3)));
    }
    BoxTree tree(boxes);
    for (auto _ : state) {
        tree.refit(boxes);
        benchmark::ClobberMemory();
    }
}
BENCHMARK(Refit)->Unit(benchmark::kMillisecond)->UseRealTime();

void Candidates(benchmark::State& state) {
    const ContactSurface surface = placed_surface();
    BroadPhase broad_phase(surface, true);
    std::vector<Candidate> candidates;
    for (auto _ : state) {
        broad_phase.find(surface, k_dt, candidates);
    }
    state.counters["candidates"] = static_cast<double>(candidates.size());
}
BENCHMARK(Candidates)->Unit(benchmark::kMillisecond)->UseRealTime();

void Proximities(benchmark::State& state) {
    const ContactSurface surface = placed_surface();
    const std::vector<Candidate> candidates = candidates_of(surface);
    ContactSearch search;
    std::vector<Contact> contacts;
    for (auto _ : state) {
        search.find(surface, candidates, {}, k_dt, contacts);
    }
    state.counters["contacts"] = static_cast<double>(contacts.size());
}
BENCHMARK(Proximities)->Unit(benchmark::kMillisecond)->UseRealTime();

void Sweep(benchmark::State& state) {
    ContactSurface surface = placed_surface();
    const std::vector<Candidate> candidates = candidates_of(surface);
    std::vector<ContactRow> rows;
    for (const Candidate& candidate : candidates) {
        if (const auto place = near_place(surface, candidate)) {
            rows.push_back(make_row(surface, candidate, *place, k_dt));
        }
    }
    std::vector<char> touched(surface.start.size(), 0);
    for (auto _ : state) {
        benchmark::DoNotOptimize(sweep(rows, surface, touched));
    }
}
BENCHMARK(Sweep)->Unit(benchmark::kMillisecond)->UseRealTime();

void ContinuousDetection(benchmark::State& state) {
    const ContactSurface surface = placed_surface();
    const std::vector<Candidate> candidates = candidates_of(surface);
    const std::vector<char> look(surface.start.size(), 1);
    ImpactSearch search;
    std::vector<Impact> impacts;
    for (auto _ : state) {
        search.find(surface, candidates, look, k_dt,
                    {.thickness_fraction = 0.3, .start_fraction = 0.7}, impacts);
    }
    state.counters["impacts"] = static_cast<double>(impacts.size());
}
BENCHMARK(ContinuousDetection)->Unit(benchmark::kMillisecond)->UseRealTime();

void WholeSubstep(benchmark::State& state) {
    ContactSolver solver(draped().world, {});
    std::vector<Vec3> velocities = draped().velocities;
    std::vector<Contact> contacts;
    ContactReport report;
    for (auto _ : state) {
        velocities = draped().velocities;
        solver.find_contacts(draped().world, draped().held, k_dt, contacts);
        report = solver.resolve(draped().world, velocities, draped().held, k_dt, contacts);
    }
    state.counters["obstacle"] = report.contacts_obstacle;
    state.counters["self"] = report.contacts_self;
    state.counters["impacts"] = report.impacts;
}
BENCHMARK(WholeSubstep)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

} // namespace weft

BENCHMARK_MAIN();
