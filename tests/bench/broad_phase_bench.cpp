#include "collide/broad_phase.h"
#include "collide/crossings.h"
#include "support/contact_world.h"

#include <benchmark/benchmark.h>

#include <map>
#include <numbers>

// How the search for candidates grows from a thousand triangles to a million: a sheet folded like
// an accordion, and one draped over a sphere of as many triangles. Cells stay 5 mm wide and the
// thickness a fifth of that, so that a triangle has as many neighbours at every size; the sheet
// grows. `per_triangle` (time) of a search that keeps to n log n grows by the logarithm alone.

namespace weft {

namespace {

constexpr double k_cell = 5e-3;      // m
constexpr double k_thickness = 1e-3; // m
constexpr double k_dt = 0.005;       // s
constexpr int k_fold = 24;           // cells from fold to fold

struct Placed {
    World world;
    ContactSurface surface;
};

/// Layers 1.5 thicknesses apart, which turn back in half circles.
Vec3 folded(const Vec3& x) {
    const double length = k_fold * k_cell;
    const double radius = 0.75 * k_thickness;
    const double period = length + std::numbers::pi * radius;
    const double layer = std::floor(x.x() / period);
    const double along = x.x() - layer * period;
    const double angle = std::max(0.0, along - length) / radius;
    const double forth = std::min(along, length) + radius * std::sin(angle);
    const double height = 2.0 * radius * layer + radius * (1.0 - std::cos(angle));
    const bool is_back = std::fmod(std::abs(layer), 2.0) == 1.0;
    return {is_back ? length - forth : forth, height, x.z()};
}

/// A cap on a sphere, then a skirt in folds whose number grows with the sheet.
Vec3 draped(const Vec3& x, double radius) {
    const double s = x.norm();
    const double angle = std::atan2(x.z(), x.x());
    const double turn = 0.5 * std::numbers::pi;
    const double over = radius + 1.1 * k_thickness;
    const double hanging = std::max(0.0, s - turn * over);
    const double polar = std::min(s / over, turn);
    const double out = over * std::sin(polar) + 0.4 * hanging * (1.0 + std::cos(9.0 * angle));
    return {out * std::cos(angle), over * std::cos(polar) - hanging, out * std::sin(angle)};
}

Placed make_placed(int cells, bool over_sphere) {
    Placed made;
    FabricParams fabric;
    fabric.thickness = k_thickness;
    const double size = cells * k_cell;
    test::add_sheet(made.world, cells, size, 0.0, fabric);
    if (over_sphere) {
        // 20 * 4^level triangles, the nearest number to the sheet's 2 * cells^2
        const int level =
            std::max(1, static_cast<int>(std::lround(std::log2(0.1 * cells * cells) / 2.0)));
        test::add_sphere(made.world, 0.3 * size, Vec3::Zero(), level);
    }
    for (Vec3& x : made.world.positions) {
        x = over_sphere ? draped(x, 0.3 * size) : folded(x);
    }
    const std::vector<Vec3> velocities(made.world.vertex_count(), Vec3(0.0, -9.81 * k_dt, 0.0));
    const std::vector<char> held(made.world.vertex_count(), 0);
    made.surface = make_surface(made.world);
    place_surface(made.surface, made.world, velocities, held, k_dt);
    return made;
}

/// Only the last is kept: a large one takes a gigabyte.
const Placed& placed_of(int cells, bool over_sphere) {
    static std::pair<int, bool> made{-1, false};
    static Placed placed;
    if (made != std::pair(cells, over_sphere)) {
        placed = {};
        placed = make_placed(cells, over_sphere);
        made = {cells, over_sphere};
    }
    return placed;
}

void report(benchmark::State& state, const ContactSurface& surface, std::size_t found) {
    const auto triangles = static_cast<double>(surface.triangles.size());
    state.SetComplexityN(static_cast<benchmark::IterationCount>(surface.triangles.size()));
    state.counters["triangles"] = triangles;
    state.counters["found_per_triangle"] = static_cast<double>(found) / triangles;
    state.counters["per_triangle"] = benchmark::Counter(
        triangles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void candidates(benchmark::State& state, bool over_sphere) {
    const ContactSurface& surface =
        placed_of(static_cast<int>(state.range(0)), over_sphere).surface;
    BroadPhase broad_phase(surface, true);
    std::vector<Candidate> candidates;
    broad_phase.find(surface, k_dt, candidates); // builds the trees
    for (auto _ : state) {
        broad_phase.find(surface, k_dt, candidates);
    }
    report(state, surface, candidates.size());
}

void CandidatesFolded(benchmark::State& state) {
    candidates(state, false);
}

void CandidatesOverSphere(benchmark::State& state) {
    candidates(state, true);
}

void Build(benchmark::State& state) {
    const ContactSurface& surface = placed_of(static_cast<int>(state.range(0)), false).surface;
    std::vector<Candidate> candidates;
    for (auto _ : state) {
        BroadPhase broad_phase(surface, true);
        broad_phase.find(surface, k_dt, candidates);
    }
    report(state, surface, candidates.size());
}

void Crossings(benchmark::State& state) {
    const ContactSurface& surface = placed_of(static_cast<int>(state.range(0)), true).surface;
    CrossingSearch search(surface, true);
    std::size_t found = search.find(surface, surface.start).size();
    for (auto _ : state) {
        found = search.find(surface, surface.start).size();
    }
    report(state, surface, found);
}

/// Cells a side: 1, 4, 16, 64, 256 thousand triangles and a million.
void sizes(benchmark::internal::Benchmark* benchmark) {
    for (const int cells : {22, 45, 90, 181, 362, 724}) {
        benchmark->Arg(cells);
    }
    benchmark->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->Complexity(benchmark::oNLogN);
}

BENCHMARK(CandidatesFolded)->Apply(sizes);
BENCHMARK(CandidatesOverSphere)->Apply(sizes);
BENCHMARK(Build)->Apply(sizes);
BENCHMARK(Crossings)->Apply(sizes);

} // namespace

} // namespace weft

BENCHMARK_MAIN();
