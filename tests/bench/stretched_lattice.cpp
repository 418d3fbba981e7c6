#include "base/parallel.h"
#include "solver/conjugate_gradient.h"
#include "state/edge_network.h"
#include "step/force_system.h"
#include "validation/experiment_world.h"

#include <fmt/core.h>

#include <cmath>

/// Figure 3 of Vogiannou et al. 2010: a lattice held at two opposite edges sags under its weight,
/// then the edges are moved apart until it has twice its rest area. Steps are those of the paper,
/// one linearisation of implicit Euler and so many conjugate gradient iterations with the diagonal
/// as preconditioner; Weft's own step solves to a tolerance. Prints CSV of the rms velocity across
/// the sheet, for each way to step.
///
/// Paper: 2 iterations, b and d times 0.99 in the Jacobian or not. Ours: the rest (16 x 16
/// particles, 2 cm, K = 500 N/m, K1 = 6 K, K2 = 2 K at 1.1 and 0.9, 0.25 kg, 10 and 40 ms, each
/// edge 5 cm/s, diagonals as stiff as sides).
namespace weft {

namespace {

constexpr int k_cells = 15;
constexpr double k_edge = 0.02, k_speed = 0.05; // m, m/s
constexpr double k_size = k_cells * k_edge;
constexpr double k_sag_time = 1.0;                       // s
constexpr double k_pull_time = 0.5 * k_size / k_speed;   // s, to twice the length
constexpr double k_end = k_sag_time + k_pull_time + 2.0; // s

class Lattice {
public:
    Lattice(double dt, double jacobian_damping, int iterations)
        : dt_(dt), iterations_(iterations), world_(make_world(jacobian_damping)),
          system_(world_, empty_space()) {
        const std::size_t n = world_.vertex_count();
        matrix_ = system_.assembler().pattern();
        for (auto* values : {&forces_, &right_, &change_, &moved_, &product_}) {
            values->resize(n, Vec3::Zero());
        }
        for (std::size_t i = 0; i < n; ++i) {
            const double x = world_.positions[i].x();
            side_.push_back(x < 1e-9 ? -1 : x > k_size - 1e-9 ? 1 : 0);
        }
    }

    void step(double time) {
        const std::size_t n = world_.vertex_count();
        auto& v = world_.velocities;
        const bool pulls = time >= k_sag_time && time < k_sag_time + k_pull_time;
        for (std::size_t i = 0; i < n; ++i) {
            if (side_[i] != 0) {
                v[i] = pulls ? Vec3(side_[i] * k_speed, 0.0, 0.0) : Vec3(Vec3::Zero());
            }
        }
        system_.evaluate(world_.positions, v, {dt_ * dt_, dt_}, forces_);
        system_.assemble(world_.masses, matrix_);
        const auto rows = system_.assembler().row_of_vertex();
        // (M + h D + h^2 K) dv = h (f - h K v), and with no damping h^2 K v = A v - M v
        for (std::size_t i = 0; i < n; ++i) {
            moved_[row(i)] = v[i];
        }
        multiply(matrix_, moved_, product_);
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 force = forces_[i] + world_.masses[i] * Vec3(0.0, -9.81, 0.0);
            right_[row(i)] = dt_ * force - (product_[row(i)] - world_.masses[i] * v[i]);
        }
        hold(rows);
        std::fill(change_.begin(), change_.end(), Vec3::Zero());
        solver_.solve(matrix_,
                      [&](std::span<const Vec3> r, std::span<Vec3> z) {
                          for (std::size_t i = 0; i < r.size(); ++i) {
                              const Mat3& d =
                                  matrix_.blocks[static_cast<std::size_t>(matrix_.diagonal[i])];
                              z[i] = r[i].cwiseQuotient(d.diagonal());
                          }
                      },
                      right_, change_, {.tolerance = 1e-10, .max_iterations = iterations_});
        for (std::size_t i = 0; i < n; ++i) {
            v[i] += change_[row(i)];
            world_.positions[i] += dt_ * v[i];
        }
    }

    /// Root of the mean square of the velocity across the sheet (y), m/s.
    double speed_across() const {
        double sum = 0.0;
        for (const Vec3& v : world_.velocities) {
            sum += v.y() * v.y();
        }
        return std::sqrt(sum / static_cast<double>(world_.vertex_count()));
    }

private:
    std::size_t row(std::size_t vertex) const {
        return static_cast<std::size_t>(system_.assembler().row_of_vertex()[vertex]);
    }

    /// Held particles do not change their velocity: their rows become the identity.
    void hold(std::span<const Index> rows) {
        std::vector<char> is_held(rows.size(), 0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            is_held[static_cast<std::size_t>(rows[i])] = side_[i] != 0 ? 1 : 0;
        }
        for (std::size_t r = 0; r < matrix_.rows(); ++r) {
            for (Index k = matrix_.row_begin[r]; k < matrix_.row_begin[r + 1]; ++k) {
                const auto place = static_cast<std::size_t>(k);
                const auto c = static_cast<std::size_t>(matrix_.column[place]);
                if (is_held[r] != 0 || is_held[c] != 0) {
                    matrix_.blocks[place] = r == c ? Mat3(Mat3::Identity()) : Mat3(Mat3::Zero());
                }
            }
            if (is_held[r] != 0) {
                right_[r].setZero();
            }
        }
    }

    static World make_world(double jacobian_damping) {
        ClothParams params;
        params.model = Model::Cubic;
        params.grid_size = {k_size, k_size};
        params.grid_cells = {k_cells, k_cells};
        params.spring = {.K = 500.0, .K1 = 3000.0, .K2 = 1000.0, .bend = 0.0};
        params.spring.jacobian_damping = jacobian_damping;
        params.fabric.area_density = 0.25 / (k_size * k_size);
        World world = sheet_world(union_jack_sheet(k_cells, k_cells, k_size, k_size), params,
                                  [](const Vec2& p) { return Vec3(p.x(), 0.0, p.y()); });
        Cloth& cloth = world.cloths[0];
        std::vector<Index> cells;
        for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
            cells.push_back(static_cast<Index>(t / 2));
        }
        cloth.network = cloth_network(cloth, cells);
        return world;
    }

    double dt_; ///< s
    int iterations_;
    World world_;
    ForceSystem system_;
    BlockMatrix matrix_;
    ConjugateGradient solver_;
    std::vector<int> side_; ///< -1, 1: held, of which edge
    std::vector<Vec3> forces_, right_, change_, moved_, product_;
};

} // namespace

} // namespace weft

int main() {
    weft::set_thread_count(1);
    fmt::print("dt_s,jacobian_damping,iterations,time_s,rms_across_m_s\n");
    for (const double dt : {0.01, 0.04}) {
        for (const int iterations : {2, 1000}) {
            for (const double damping : {1.0, 0.99}) {
                weft::Lattice lattice(dt, damping, iterations);
                const int steps = static_cast<int>(std::lround(weft::k_end / dt));
                for (int i = 0; i < steps; ++i) {
                    lattice.step(i * dt);
                    fmt::print("{},{},{},{:.2f},{:.6g}\n", dt, damping, iterations, (i + 1) * dt,
                               lattice.speed_across());
                }
            }
        }
    }
    return 0;
}
