#include "base/parallel.h"
#include "base/stopwatch.h"
#include "geometry/shapes.h"
#include "solver/conjugate_gradient.h"
#include "state/edge_network.h"
#include "step/force_system.h"
#include "validation/experiment_world.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

/// What a step costs by the model of the cloth: forces and Jacobian, their assembly into the
/// matrix, and a solve of the same few iterations, on the same triangles (edges are those of the
/// mesh, none across, none for bending), one thread. The models take turns, so that the machine's
/// moods meet all alike; of each the median over the rounds, of ratios the median of the ratios in
/// a round. Prints CSV.
///
///     edge_bench [CELLS [ITERATIONS [ROUNDS]]]
///
/// ITERATIONS 0: as many as bring the residual to 1e-4 of the right-hand side.
namespace weft {

namespace {

constexpr double k_dt = 0.005;

struct Times {
    double forces, assembly, solve; ///< ms
    int iterations;
    double total() const { return forces + assembly + solve; }
};

class Contender {
public:
    Contender(Model model, int cells) : world_(make_world(model, cells)), system_(world_, space()) {
        const std::size_t n = world_.vertex_count();
        matrix_ = system_.assembler().pattern();
        forces_.resize(n);
        right_.resize(n);
        change_.resize(n);
    }

    Times step(int iterations) {
        Times times{};
        Stopwatch watch;
        system_.evaluate(world_.positions, world_.velocities, {k_dt * k_dt, k_dt}, forces_);
        times.forces = 1e3 * watch.seconds();
        watch.restart();
        system_.assemble(world_.masses, matrix_);
        times.assembly = 1e3 * watch.seconds();
        const auto rows = system_.assembler().row_of_vertex();
        for (std::size_t v = 0; v < rows.size(); ++v) {
            right_[static_cast<std::size_t>(rows[v])] = k_dt * forces_[v];
        }
        std::fill(change_.begin(), change_.end(), Vec3::Zero());
        watch.restart();
        const bool is_fixed = iterations > 0;
        const CgReport report = solver_.solve(
            matrix_,
            [&](std::span<const Vec3> r, std::span<Vec3> z) {
                for (std::size_t i = 0; i < r.size(); ++i) {
                    const Mat3& d = matrix_.blocks[static_cast<std::size_t>(matrix_.diagonal[i])];
                    z[i] = r[i].cwiseQuotient(d.diagonal());
                }
            },
            right_, change_,
            {.tolerance = is_fixed ? 0.0 : 1e-4, .max_iterations = is_fixed ? iterations : 10000});
        times.solve = 1e3 * watch.seconds();
        times.iterations = report.iterations;
        return times;
    }

private:
    static SceneParams space() { return empty_space(); }

    static World make_world(Model model, int cells) {
        ClothParams params;
        params.model = model;
        params.spring = {.K = 500.0, .K1 = 3000.0, .K2 = 1000.0, .bend = 0.0};
        const double size = 0.02 * cells;
        World world =
            sheet_world(one_diagonal_sheet(cells, cells, size, size), params, [](const Vec2& p) {
                return Vec3(1.02 * p.x(), 0.99 * p.y(),
                            0.004 * std::sin(130.0 * p.x() + 70.0 * p.y()));
            });
        Cloth& cloth = world.cloths[0];
        std::vector<Index> polygons;
        for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
            polygons.push_back(static_cast<Index>(t));
        }
        cloth.network = cloth_network(cloth, polygons);
        return world;
    }

    World world_;
    ForceSystem system_;
    BlockMatrix matrix_;
    ConjugateGradient solver_;
    std::vector<Vec3> forces_, right_, change_;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

void compare_models(int cells, int iterations, int rounds) {
    constexpr std::array k_names{"linear", "stvk_edge", "cubic", "stvk_triangle"};
    std::array contenders{Contender(Model::Linear, cells), Contender(Model::StvkEdge, cells),
                          Contender(Model::Cubic, cells), Contender(Model::StvkTriangle, cells)};
    std::array<std::vector<Times>, 4> times;
    for (int round = -2; round < rounds; ++round) { // two to warm up
        for (std::size_t m = 0; m < contenders.size(); ++m) {
            const Times t = contenders[m].step(iterations);
            if (round >= 0) {
                times[m].push_back(t);
            }
        }
    }
    fmt::print("model,particles,iterations,forces_ms,assembly_ms,solve_ms,total_ms,over_linear\n");
    for (std::size_t m = 0; m < contenders.size(); ++m) {
        const auto middle = [&](auto&& value) {
            std::vector<double> values;
            for (std::size_t i = 0; i < times[m].size(); ++i) {
                values.push_back(value(times[m][i], times[0][i]));
            }
            return median(values);
        };
        fmt::print("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", k_names[m],
                   (cells + 1) * (cells + 1), times[m].back().iterations,
                   middle([](const Times& t, const Times&) { return t.forces; }),
                   middle([](const Times& t, const Times&) { return t.assembly; }),
                   middle([](const Times& t, const Times&) { return t.solve; }),
                   middle([](const Times& t, const Times&) { return t.total(); }),
                   middle([](const Times& t, const Times& l) { return t.total() / l.total(); }));
    }
}

} // namespace weft

int main(int argc, char** argv) {
    const auto argument = [&](int i, int otherwise) {
        return argc > i ? std::atoi(argv[i]) : otherwise;
    };
    weft::set_thread_count(1);
    weft::compare_models(argument(1, 31), argument(2, 2), argument(3, 400));
    return 0;
}
