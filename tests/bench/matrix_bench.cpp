#include "adapt/sqrt3_mesh.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "solver/conjugate_gradient.h"
#include "solver/preconditioner.h"
#include "step/force_system.h"
#include "support/adaptive_cloths.h"
#include "support/changing_sheet.h"
#include "support/worlds.h"

#include <benchmark/benchmark.h>

#include <cmath>

/// What it costs to bring forces and matrix to a mesh of which one triangle in a hundred has
/// changed (of edits all over, edits in one part, a band of refinement that moves), beside making
/// them anew and beside the solve that comes after: sheets of n×n cells (2 triangles each), on one
/// thread.
namespace weft {

namespace {

constexpr SystemScales k_scales{1e-4, 1e-2}; // dt = 10 ms

World world_of(const Cloth& cloth, std::span<const Vec2> points) {
    World world;
    world.cloths.push_back(cloth);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2& m = points[i];
        world.positions.emplace_back(1.02 * m.x(), 0.02 * std::sin(13.0 * m.x() + 7.0 * m.y()),
                                     0.99 * m.y());
        world.velocities.emplace_back(0.0, std::cos(9.0 * m.x()), 0.0);
        world.masses.push_back(0.2 * cloth.rest_areas[i]);
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
        before = world_of(old.cloth(), old.points());
        // an edit changes two triangles or three; some fall on the same one
        const double edits = 0.01 * 2.0 * cells * cells / 1.25;
        there.push_back(sheet.change(static_cast<int>(edits), 0.5, window));
        after = world_of(sheet.cloth(), sheet.points());
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
    system.remesh(meshes.after, meshes.there);
    system.remesh(meshes.before, meshes.back);
    bool is_there = false;
    for (auto _ : bench) {
        is_there ? system.remesh(meshes.before, meshes.back)
                 : system.remesh(meshes.after, meshes.there);
        is_there = !is_there;
    }
    bench.counters["changed"] = meshes.changed_share();
    set_thread_count(0);
}

/// A band of finer triangles that moves over a sheet, as refinement follows a fold.
class MovingBand {
public:
    explicit MovingBand(int cells)
        : cloth_(test::adaptive_sheet(union_jack_sheet(cells, cells, 1.0, 1.0))), mesh_(cloth_) {
        cloth_.params.fabric = test::record_sheet(cells).fabric;
        for (int i = 0; i < 4; ++i) {
            move(0.0);
        }
    }

    /// Moves it by some metres and lets the mesh follow by one generation.
    ClothChanges move(double distance) {
        centre_ += distance;
        mesh_.begin(cloth_, {}, {.max_level = 2});
        const auto count = static_cast<Index>(cloth_.triangles.size());
        for (Index t = 0; t < count; ++t) {
            if (is_inside(cloth_.triangles[static_cast<std::size_t>(t)][0]) &&
                mesh_.can_refine(t)) {
                mesh_.refine(t);
            }
        }
        for (Index v = 0; v < cloth_.vertex_count; ++v) {
            if (!is_inside(v) && mesh_.can_remove(v)) {
                mesh_.remove(v);
            }
        }
        return mesh_.finish();
    }

    const Cloth& cloth() const { return cloth_; }

private:
    bool is_inside(Index v) const {
        const Vec2& m = cloth_.material_positions[static_cast<std::size_t>(v)];
        return std::abs(m.x() - centre_) < 0.1;
    }

    Cloth cloth_;
    Sqrt3Mesh mesh_;
    double centre_ = 0.15;
};

void adapt_to_moving_band(benchmark::State& bench) {
    MovingBand band(static_cast<int>(bench.range(0)));
    set_thread_count(1);
    ForceSystem system(world_of(band.cloth(), band.cloth().material_positions), {});
    double changed = 0.0;
    double way = 0.005;
    double x = 0.0;
    for (auto _ : bench) {
        way = x > 0.6 ? -0.005 : x < 0.0 ? 0.005 : way;
        x += way;
        const std::vector<ClothChanges> changes{band.move(way)};
        const World world = world_of(band.cloth(), band.cloth().material_positions);
        changed += static_cast<double>(changes[0].triangles.size()) /
                   static_cast<double>(world.triangle_count());
        const Stopwatch watch;
        system.remesh(world, changes);
        bench.SetIterationTime(watch.seconds());
    }
    bench.counters["changed"] = changed / static_cast<double>(bench.iterations());
    bench.counters["triangles"] = static_cast<double>(band.cloth().triangles.size());
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
        report = cg.solve(
            matrix, [&](std::span<const Vec3> r, std::span<Vec3> z) { preconditioner.apply(r, z); },
            right, change, {});
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
BENCHMARK(adapt_to_moving_band)->WEFT_SIZES->UseManualTime();
BENCHMARK(make_anew)->WEFT_SIZES;
BENCHMARK(assemble)->WEFT_SIZES;
BENCHMARK(solve)->WEFT_SOLVED_SIZES;

} // namespace weft

BENCHMARK_MAIN();
