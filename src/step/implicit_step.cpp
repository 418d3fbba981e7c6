#include "step/implicit_step.h"

#include "base/parallel.h"
#include "base/stopwatch.h"

#include <cmath>

namespace weft {

namespace {

/// A full Newton change is taken when the slope of the potential along it has fallen to this share
/// of its start. Larger: overshoots are let through; smaller: steps are cut that would have been
/// good.
constexpr double k_slope_share = 0.5;
constexpr int k_most_halvings = 10;

/// How much rougher the solve is that only shows which contacts hold.
constexpr double k_rough = 10.0;

/// Rough solves at most. Fewer: some contacts hold what others have let go of, and a sheet sticks
/// just above its friction angle; more: nothing changes any more.
constexpr int k_rough_rounds = 4;

bool all_finite(std::span<const Vec3> values) {
    return parallel_reduce(
        values.size(), true, [&](std::size_t i) { return values[i].allFinite(); },
        [](bool a, bool b) { return a && b; });
}

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
    return parallel_sum(a.size(), [&](std::size_t i) { return a[i].dot(b[i]); });
}

/// Springs of contacts are as stiff as the membrane: half the sum of its moduli.
std::vector<double> contact_stiffness(const World& world) {
    std::vector<double> stiffness(world.vertex_count(), 0.0);
    for (const Cloth& cloth : world.cloths) {
        for (Index i = cloth.first_vertex; i < cloth.first_vertex + cloth.vertex_count; ++i) {
            stiffness[static_cast<std::size_t>(i)] =
                0.5 * cloth.params.fabric.stretch_stiffness.sum();
        }
    }
    return stiffness;
}

std::vector<double> mass_damping(const World& world) {
    std::vector<double> damping(world.vertex_count(), 0.0);
    for (const Cloth& cloth : world.cloths) {
        for (Index i = cloth.first_vertex; i < cloth.first_vertex + cloth.vertex_count; ++i) {
            const auto v = static_cast<std::size_t>(i);
            damping[v] = cloth.params.fabric.damping[0] * world.masses[v];
        }
    }
    return damping;
}

} // namespace

ImplicitStep::ImplicitStep(const World& world, const SceneParams& params)
    : params_(params), masses_(world.masses), mass_damping_(mass_damping(world)),
      forces_(world, params), contact_forces_(contact_stiffness(world)),
      matrix_(forces_.assembler().pattern()) {
    const std::size_t n = world.vertex_count();
    for (auto* values :
         {&x_base_, &v_base_, &guess_, &x_, &v_, &force_, &element_force_, &residual_, &change_,
          &trial_x_, &trial_v_, &row_rhs_, &row_change_, &row_fall_, &row_product_}) {
        values->assign(n, Vec3::Zero());
    }
    diagonal_.assign(n, 0.0);
}

ImplicitReport ImplicitStep::solve(const World& world,
                                   const HeldVertices& held,
                                   double dt,
                                   std::vector<Vec3>& end_positions,
                                   std::vector<Vec3>& end_velocities,
                                   std::span<RestingContact> resting) {
    ImplicitReport report;
    start(world, resting, dt);
    forces_.start_substep(world.velocities);
    forces_.set_attachments(world, world.time + dt);
    report.converged = true;
    for (int i = 0; i < params_.newton && report.converged; ++i) {
        if (!newton_iteration(held, i == 0, report)) {
            break;
        }
    }
    end_velocities = v_;
    end_positions.resize(v_.size());
    move_to(v_, end_positions);
    parallel_for(v_.size(), [&](std::size_t i) {
        if (held.flags[i] != 0) {
            end_positions[i] = held.targets[i];
            end_velocities[i] = (held.targets[i] - world.positions[i]) / dt;
        }
    });
    contact_forces_.report(end_positions, end_velocities, resting);
    report.converged = report.converged && all_finite(end_positions) && all_finite(end_velocities);
    return report;
}

void ImplicitStep::start(const World& world, std::span<const RestingContact> resting, double dt) {
    const bool two_step = params_.integrator == Integrator::Bdf2 && world.history_dt == dt;
    beta_ = two_step ? 2.0 / 3.0 * dt : dt;
    const Vec3 gravity_impulse = params_.gravity * dt;
    parallel_for(v_.size(), [&](std::size_t i) {
        const Vec3& x = world.positions[i];
        const Vec3& v = world.velocities[i];
        x_base_[i] = two_step ? Vec3((4.0 * x - world.previous_positions[i]) / 3.0) : x;
        v_base_[i] = two_step ? Vec3((4.0 * v - world.previous_velocities[i]) / 3.0) : v;
        x_[i] = x;
        v_[i] = (x - x_base_[i]) / beta_; // linearised where the substep starts
        trial_v_[i] = v + gravity_impulse;
        guess_[i] = v - v_[i];
    });
    contact_forces_.start(resting, world.positions, world.velocities, trial_v_, dt);
    floor_ = params_.gravity.norm() * dt *
             std::sqrt(parallel_sum(masses_.size(),
                                    [&](std::size_t i) { return masses_[i] * masses_[i]; }));
}

/// One linearisation, solved until contact agrees with it; false when it was the last one needed or
/// failed.
bool ImplicitStep::newton_iteration(const HeldVertices& held,
                                    bool is_first,
                                    ImplicitReport& report) {
    const Stopwatch watch;
    forces_.evaluate(x_, v_, {beta_ * beta_, beta_}, element_force_);
    report.seconds_forces += watch.seconds();
    parallel_for(v_.size(), [&](std::size_t i) {
        const Vec3 held_change = (held.targets[i] - x_base_[i]) / beta_ - v_[i];
        change_[i] = held.flags[i] != 0 ? held_change : is_first ? guess_[i] : Vec3(Vec3::Zero());
    });
    build_system(held, report);
    if (is_first) {
        add_best_fall(held);
    }
    // Rough solutions show which contacts hold; the solve proper starts from the last of them.
    for (int round = 0; round < k_rough_rounds && contact_forces_.acts(); ++round) {
        if (!linear_solve(k_rough * params_.solver_tolerance, report)) {
            return false;
        }
        parallel_for(v_.size(), [&](std::size_t i) { trial_v_[i] = v_[i] + change_[i]; });
        move_to(trial_v_, trial_x_);
        if (!contact_forces_.revise(trial_x_, trial_v_)) {
            break;
        }
        build_system(held, report);
    }
    if (!linear_solve(params_.solver_tolerance, report)) {
        return false;
    }
    ++report.newton_iterations;

    const double slope = -dot(residual_, change_);
    const double length = params_.newton > 1 && !is_first ? line_search(slope) : 1.0;
    parallel_for(v_.size(), [&](std::size_t i) { v_[i] += length * change_[i]; });
    move_to(v_, x_);
    const double largest = std::sqrt(parallel_reduce(
        change_.size(), 0.0, [&](std::size_t i) { return change_[i].squaredNorm(); },
        [](double a, double b) { return std::max(a, b); }));
    constexpr double k_small_change = 1e-9; // m/s: a further iteration would change nothing visible
    return largest > k_small_change;
}

/// Matrix, right-hand side and preconditioner of the linearisation at (x_, v_) with contact as it
/// acts now; change_ becomes the guess.
void ImplicitStep::build_system(const HeldVertices& held, ImplicitReport& report) {
    Stopwatch watch;
    find_residual();
    parallel_for(diagonal_.size(),
                 [&](std::size_t i) { diagonal_[i] = masses_[i] + beta_ * mass_damping_[i]; });
    forces_.assemble(diagonal_, matrix_);
    contact_forces_.add_blocks(beta_, forces_.assembler().row_of_vertex(), matrix_);
    to_rows(residual_, row_rhs_);
    to_rows(change_, row_change_);
    eliminate_held(held);
    report.seconds_assembly += watch.seconds();

    watch.restart();
    preconditioner_.factor(matrix_);
    report.seconds_solve += watch.seconds();
}

/// Finds change_ from the system, starting from the guess.
bool ImplicitStep::linear_solve(double tolerance, ImplicitReport& report) {
    const Stopwatch watch;
    const CgReport cg = cg_.solve(matrix_, preconditioner_, row_rhs_, row_change_,
                                  {.tolerance = tolerance, .floor = floor_});
    report.seconds_solve += watch.seconds();
    report.cg_iterations += cg.iterations;
    report.residual = cg.residual;
    report.converged = cg.converged;
    to_vertices(row_change_, change_);
    return cg.converged;
}

/// Adds to the guess the multiple of a uniform fall that lowers the solve's energy most: all of it
/// for cloth in the air, nothing for cloth at rest.
void ImplicitStep::add_best_fall(const HeldVertices& held) {
    parallel_for(v_.size(), [&](std::size_t i) {
        trial_v_[i] = held.flags[i] != 0 ? Vec3(Vec3::Zero()) : params_.gravity;
    });
    to_rows(trial_v_, row_fall_);
    multiply(matrix_, row_fall_, row_product_);
    const double curvature = dot(row_fall_, row_product_);
    if (curvature > 0.0) {
        const double length =
            (dot(row_fall_, row_rhs_) - dot(row_change_, row_product_)) / curvature;
        parallel_for(row_change_.size(),
                     [&](std::size_t r) { row_change_[r] += length * row_fall_[r]; });
    }
}

/// residual = -(M (v - v_base) - beta f): the right-hand side of the Newton system, N s.
void ImplicitStep::find_residual() {
    force_ = element_force_;
    contact_forces_.add_forces(x_, v_, force_);
    parallel_for(v_.size(), [&](std::size_t i) {
        force_[i] += masses_[i] * params_.gravity - mass_damping_[i] * v_[i];
        residual_[i] = beta_ * force_[i] - masses_[i] * (v_[i] - v_base_[i]);
    });
}

/// Moves the known changes of held vertices to the right-hand side and makes their rows the
/// identity.
void ImplicitStep::eliminate_held(const HeldVertices& held) {
    const auto rows = forces_.assembler().row_of_vertex();
    for (std::size_t v = 0; v < held.flags.size(); ++v) {
        if (held.flags[v] == 0) {
            continue;
        }
        const auto r = static_cast<std::size_t>(rows[v]);
        const Vec3 known = row_change_[r];
        for (Index k = matrix_.row_begin[r]; k < matrix_.row_begin[r + 1]; ++k) {
            const auto c = static_cast<std::size_t>(matrix_.column[static_cast<std::size_t>(k)]);
            if (c == r) {
                continue;
            }
            const Index mirror = find_block(matrix_, static_cast<Index>(c), static_cast<Index>(r));
            Mat3& across = matrix_.blocks[static_cast<std::size_t>(mirror)];
            row_rhs_[c] -= across * known;
            across.setZero();
            matrix_.blocks[static_cast<std::size_t>(k)].setZero();
        }
        matrix_.blocks[static_cast<std::size_t>(matrix_.diagonal[r])] =
            masses_[v] * Mat3::Identity();
    }
    for (std::size_t v = 0; v < held.flags.size(); ++v) {
        if (held.flags[v] != 0) { // after all moves: a held neighbour must not disturb it
            const auto r = static_cast<std::size_t>(rows[v]);
            row_rhs_[r] = masses_[v] * row_change_[r];
        }
    }
}

/// Length in (0, 1] of the change, halved until the slope of the incremental potential along it,
/// which is change . gradient, is no more than a share of its (negative) start.
double ImplicitStep::line_search(double slope_start) {
    double length = 1.0;
    for (int i = 0; i < k_most_halvings; ++i, length *= 0.5) {
        parallel_for(v_.size(), [&](std::size_t k) { trial_v_[k] = v_[k] + length * change_[k]; });
        move_to(trial_v_, trial_x_);
        forces_.forces_only(trial_x_, trial_v_, force_);
        contact_forces_.add_forces(trial_x_, trial_v_, force_);
        const double slope = parallel_sum(v_.size(), [&](std::size_t k) {
            const Vec3 f =
                force_[k] + masses_[k] * params_.gravity - mass_damping_[k] * trial_v_[k];
            return change_[k].dot(masses_[k] * (trial_v_[k] - v_base_[k]) - beta_ * f);
        });
        if (slope <= k_slope_share * std::abs(slope_start)) {
            return length;
        }
    }
    return length;
}

void ImplicitStep::move_to(std::span<const Vec3> velocities, std::span<Vec3> positions) const {
    parallel_for(positions.size(),
                 [&](std::size_t i) { positions[i] = x_base_[i] + beta_ * velocities[i]; });
}

void ImplicitStep::to_rows(std::span<const Vec3> by_vertex, std::span<Vec3> by_row) const {
    const auto rows = forces_.assembler().row_of_vertex();
    parallel_for(by_vertex.size(),
                 [&](std::size_t v) { by_row[static_cast<std::size_t>(rows[v])] = by_vertex[v]; });
}

void ImplicitStep::to_vertices(std::span<const Vec3> by_row, std::span<Vec3> by_vertex) const {
    const auto rows = forces_.assembler().row_of_vertex();
    parallel_for(by_vertex.size(),
                 [&](std::size_t v) { by_vertex[v] = by_row[static_cast<std::size_t>(rows[v])]; });
}

} // namespace weft
