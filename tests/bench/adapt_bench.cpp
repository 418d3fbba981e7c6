#include "adapt/sqrt3_mesh.h"
#include "support/adaptive_cloths.h"

#include <benchmark/benchmark.h>

#include <map>

// What one adaptation costs on meshes from a thousand triangles to a million: a patch of two
// hundred triangles somewhere is refined twice and, in the next adaptation, coarsened again.
// `per_event` (time) of a vertex put in or taken out must not grow with the mesh, but for the
// memory that is no longer in the caches.

namespace weft {

namespace {

constexpr int k_patch = 10; // cells a side, of two triangles

struct Adapted {
    Cloth cloth;
    Sqrt3Mesh mesh;
    Index cells;
    unsigned place = 0;

    explicit Adapted(Index n)
        : cloth(test::adaptive_sheet(union_jack_sheet(n, n, 1.0, 1.0))), mesh(cloth), cells(n) {}
};

Adapted& adapted(Index cells) {
    static std::map<Index, Adapted> made; // a million triangles take a second to make
    return made.try_emplace(cells, cells).first->second;
}

/// The triangles of the next patch, and what became of them.
std::vector<Index> next_patch(Adapted& a) {
    const auto range = static_cast<unsigned>(a.cells - k_patch + 1);
    const auto left = static_cast<Index>(a.place * 7919U % range);
    const auto top = static_cast<Index>(a.place * 104729U % range);
    ++a.place;
    std::vector<Index> triangles;
    for (Index j = top; j < top + k_patch; ++j) {
        for (Index i = left; i < left + k_patch; ++i) {
            triangles.push_back(2 * (j * a.cells + i));
            triangles.push_back(2 * (j * a.cells + i) + 1);
        }
    }
    return triangles;
}

Index refine(Adapted& a, const std::vector<Index>& patch) {
    const Index before = a.cloth.vertex_count;
    a.mesh.begin(a.cloth, {}, {.max_level = 2});
    for (int step = 0; step < 2; ++step) {
        for (const Index t : patch) {
            a.mesh.refine(t);
        }
    }
    benchmark::DoNotOptimize(a.mesh.finish());
    return a.cloth.vertex_count - before;
}

void coarsen(Adapted& a) {
    a.mesh.begin(a.cloth, {}, {.max_level = 2});
    for (bool is_changing = true; is_changing;) {
        is_changing = false;
        for (Index v = a.cloth.vertex_count - 1; v >= a.cloth.refinement.base_vertices; --v) {
            if (a.mesh.can_remove(v)) {
                is_changing = a.mesh.remove(v) || is_changing;
            }
        }
    }
    benchmark::DoNotOptimize(a.mesh.finish());
}

void refine_and_coarsen(benchmark::State& state) {
    Adapted& a = adapted(static_cast<Index>(state.range(0)));
    Index events = 0;
    for (auto _ : state) {
        const std::vector<Index> patch = next_patch(a);
        events += 2 * refine(a, patch);
        coarsen(a);
    }
    if (!a.cloth.refinement.vertices.empty()) {
        state.SkipWithError("the imported mesh did not come back");
    }
    state.counters["triangles"] = static_cast<double>(a.cloth.triangles.size());
    state.counters["per_event"] = benchmark::Counter(
        static_cast<double>(events), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(refine_and_coarsen)->Arg(22)->Arg(71)->Arg(224)->Arg(707)->Unit(benchmark::kMicrosecond);

} // namespace

} // namespace weft

BENCHMARK_MAIN();
