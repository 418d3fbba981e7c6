#include "base/parallel.h"
#include "forces/air.h"
#include "forces/bending.h"
#include "forces/constant_bending.h"
#include "forces/membrane.h"
#include "support/sheets.h"

#include <benchmark/benchmark.h>

#include <cmath>

/// One evaluation of each force over 64×64 cells (8192 triangles), on one thread.
namespace weft {

namespace {

struct State {
    Sheet sheet = union_jack_sheet(64, 64, 1.0, 1.0);
    std::vector<Vec3> x = test::placed(sheet, [](const Vec2& m) {
        return Vec3(1.02 * m.x(), 0.05 * std::sin(13.0 * m.x() + 7.0 * m.y()), 0.99 * m.y());
    });
    std::vector<Vec3> v =
        test::placed(sheet, [](const Vec2& m) { return Vec3(m.y(), m.x(), m.x() * m.y()); });

    Cloth cloth(double damping, BendModel model = BendModel::MidEdge) const {
        return test::cloth_of(sheet, {.damping = {0.0, damping}}, model);
    }
};

template <typename Elements> void evaluate(benchmark::State& bench, const Elements& elements) {
    const State state;
    set_thread_count(1);
    std::vector<Vec3> forces(elements.nodes().size());
    std::vector<Mat3> blocks(elements.size() *
                             static_cast<std::size_t>(block_count(Elements::k_nodes)));
    for (auto _ : bench) {
        elements.evaluate(state.x, state.v, {1e-4, 1e-2}, forces, blocks);
        benchmark::DoNotOptimize(blocks.data());
    }
    bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(elements.size()));
}

void membrane(benchmark::State& bench) {
    evaluate(bench, MembraneElements(State().cloth(0.0)));
}

void membrane_damped(benchmark::State& bench) {
    evaluate(bench, MembraneElements(State().cloth(0.01)));
}

void bend_damping(benchmark::State& bench) {
    evaluate(bench, BendDampingElements(State().cloth(0.01)));
}

void air(benchmark::State& bench) {
    evaluate(bench, AirElements(State().cloth(0.0), {}));
}

void bending_forces(benchmark::State& bench, BendModel model) {
    const State state;
    const ConstantBending bending(state.cloth(0.0, model));
    set_thread_count(1);
    std::vector<Vec3> forces(bending.nodes().size());
    for (auto _ : bench) {
        bending.forces(state.x, forces);
        benchmark::DoNotOptimize(forces.data());
    }
    bench.SetItemsProcessed(bench.iterations() * static_cast<std::int64_t>(bending.size()));
}

} // namespace

BENCHMARK(membrane)->Unit(benchmark::kMillisecond);
BENCHMARK(membrane_damped)->Unit(benchmark::kMillisecond);
BENCHMARK(bend_damping)->Unit(benchmark::kMillisecond);
BENCHMARK(air)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bending_forces, hinges, BendModel::Quadratic)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bending_forces, mid_edge, BendModel::MidEdge)->Unit(benchmark::kMillisecond);

} // namespace weft

BENCHMARK_MAIN();
