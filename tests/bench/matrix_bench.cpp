#include "base/parallel.h"
#include "step/conjugate_gradient.h"
#include "step/force_system.h"
#include "support/changing_sheet.h"
#include "support/worlds.h"

#include <benchmark/benchmark.h>

#include <cmath>

/// What it costs to bring forces and matrix to a mesh of which one triangle in a hundred has
/// changed, beside making them anew and beside the solve that comes after: sheets of n×n cells (2
/// triangles each), on one thread.
namespace weft {

namespace {

constexpr SystemScales k_scales{1e-4, 1e-2}; // dt = 10 ms

World world_of(const test::ChangingSheet& sheet) {
    World world;
    world.cloths.push_back(sheet.cloth());
    for (std::size_t i = 0; i < sheet.points().size(); ++i) {
        const Vec2& m = sheet.points()[i];
        world.positions.emplace_back(1.02 * m.x(), 0.02 * std::sin(13.0 * m.x() + 7.0 * m.y()),
                                     0.99 * m.y());
        world.velocities.emplace_back(0.0, std::cos(9.0 * m.x()), 0.0);
        world.masses.push_back(0.2 * sheet.cloth().rest_areas[i]);
    }
    return world;
}

/// A mesh before and after a change, and the change both ways.
struct TwoMeshes {
    World before, after;
    std::vector<ClothChanges> there, back;

    /// @param window in which the triangles that change stand, as a share of all
    TwoMeshes(int cells, double window) {
        const ClothParams record = test::record_sheet(cells);
        test::ChangingSheet sheet(union_jack_sheet(cells, cells, 1.0, 1.0), record.fabric,
                                  BendModel::MidEdge, 1);
        const test::ChangingSheet old = sheet;
        before = world_of(old);
        // an edit changes two triangles or three; some fall on the same one
        const double edits = 0.01 * 2.0 * cells * cells / 1.25;
        there.push_back(sheet.change(static_cast<int>(edits), 0.5, window));
        after = world_of(sheet);
        back.push_back(sheet.changes_to(old));
    }

    double changed_share() const {
        return static_cast<double>(there[0].triangles.size()) /
               static_cast<double>(after.triangle_count());
    }
};

void adapt(benchmark::State& bench, double window) {
    const TwoMeshes meshes(static_cast<int>(bench.range(0)), window);
    set_thread_count(1);
    ForceSystem system(meshes.before, {});
    system.adapt(meshes.after, meshes.there);
    system.adapt(meshes.before, meshes.back);
    bool is_there = false;
    for (auto _ : bench) {
        is_there ? system.adapt(meshes.before, meshes.back)
                 : system.adapt(meshes.after, meshes.there);
        is_there = !is_there;
    }
    bench.counters["changed"] = meshes.changed_share();
    set_thread_count(0);
}

void make_anew(benchmark::State& bench) {
    const TwoMeshes meshes(static_cast<int>(bench.range(0)), 1.0);
    set_thread_count(1);
    for (auto _ : bench) {
        ForceSystem system(meshes.after, {});
        benchmark::DoNotOptimize(&system);
    }
    set_thread_count(0);
}

/// Forces, matrix and one solve to the usual tolerance.
void solve(benchmark::State& bench) {
    const TwoMeshes meshes(static_cast<int>(bench.range(0)), 1.0);
    const World& world = meshes.after;
    set_thread_count(1);
    ForceSystem system(world, {});
    system.start_substep(world.velocities);
    const std::size_t n = world.vertex_count();
    std::vector<Vec3> forces(n), right(n), change(n);
    BlockMatrix matrix = system.assembler().pattern();
    IncompleteCholesky preconditioner;
    ConjugateGradient cg;
    CgReport report;
    for (auto _ : bench) {
        system.evaluate(world.positions, world.velocities, k_scales, forces);
        system.assemble(world.masses, matrix);
        const auto rows = system.assembler().row_of_vertex();
        for (std::size_t v = 0; v < n; ++v) {
            right[static_cast<std::size_t>(rows[v])] = 0.01 * forces[v];
        }
        preconditioner.factor(matrix);
        std::fill(change.begin(), change.end(), Vec3::Zero());
        report = cg.solve(matrix, preconditioner, right, change, {});
    }
    bench.counters["iterations"] = report.iterations;
    set_thread_count(0);
}

void assemble(benchmark::State& bench) {
    const TwoMeshes meshes(static_cast<int>(bench.range(0)), 1.0);
    set_thread_count(1);
    ForceSystem system(meshes.before, {});
    std::vector<Vec3> forces(meshes.before.vertex_count());
    system.start_substep(meshes.before.velocities);
    system.evaluate(meshes.before.positions, meshes.before.velocities, k_scales, forces);
    BlockMatrix matrix = system.assembler().pattern();
    for (auto _ : bench) {
        system.assemble(meshes.before.masses, matrix);
        benchmark::DoNotOptimize(matrix.blocks.data());
    }
    set_thread_count(0);
}

} // namespace

#define WEFT_SIZES Arg(50)->Arg(158)->Arg(500)->Unit(benchmark::kMillisecond)
// no larger: the solve takes minutes
#define WEFT_SOLVED_SIZES Arg(50)->Arg(158)->Unit(benchmark::kMillisecond)

BENCHMARK_CAPTURE(adapt, scattered, 1.0)->WEFT_SIZES;
BENCHMARK_CAPTURE(adapt, in_one_place, 0.02)->WEFT_SIZES;
BENCHMARK(make_anew)->WEFT_SIZES;
BENCHMARK(assemble)->WEFT_SIZES;
BENCHMARK(solve)->WEFT_SOLVED_SIZES;

} // namespace weft

BENCHMARK_MAIN();
