#include "step/implicit_step.h"

#include "base/line_search.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "step/rigid_prediction.h"

#include <cassert>
#include <cmath>

namespace weft {

namespace {

constexpr int k_most_alpha_halvings = 10; ///< halvings of alpha in a Newton step

bool all_finite(std::span<const Vec3> values) {
    return parallel_reduce(
        values.size(), true, [&](std::size_t i) { return values[i].allFinite(); },
        [](bool a, bool b) { return a && b; });
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
    : params_(params), forces_(world, params), contact_forces_({}) {
    resize(world);
}

void ImplicitStep::remesh(const World& world, std::span<const ClothChanges> changes) {
    forces_.remesh(world, changes);
    resize(world);
    newton_.reset();
}

/// Sizes the arrays by vertex and by row. No solve uses values that the last one left in them.
void ImplicitStep::resize(const World& world) {
    masses_ = world.masses;
    mass_damping_ = mass_damping(world);
    contact_forces_ = ContactForces(contact_stiffness(world), make_embedding_table(world));
    const BlockMatrix& pattern = forces_.assembler().pattern();
    matrix_.row_begin = pattern.row_begin;
    matrix_.column = pattern.column;
    matrix_.diagonal = pattern.diagonal;
    const std::size_t n = world.vertex_count();
    for (auto* values : {&x_base_, &v_base_, &guess_, &x_, &v_, &force_, &residual_, &change_,
                         &linear_v_, &trial_x_, &trial_v_}) {
        values->resize(n, Vec3::Zero());
    }
    for (auto* values : {&row_residual_, &row_change_, &row_product_}) {
        values->resize(matrix_.rows(), Vec3::Zero());
    }
    diagonal_.resize(n, 0.0);
}

ImplicitReport ImplicitStep::solve(const World& world,
                                   const ConstrainedVertices& constrained,
                                   double dt,
                                   std::vector<Vec3>& end_positions,
                                   std::vector<Vec3>& end_velocities,
                                   std::span<Contact> contacts) {
    ImplicitReport report;
    start(world, dt);
    forces_.start_substep(world.velocities);
    forces_.set_attachments(world, world.time + dt);
    contact_forces_.start(world.positions, dt);
    contact_forces_.take(contacts);
    report.converged = true;
    for (int i = 0; i < params_.newton && report.converged; ++i) {
        if (!newton_iteration(constrained, i == 0, report)) {
            break;
        }
    }
    finish(world, constrained, end_positions, end_velocities, contacts, report);
    return report;
}

void ImplicitStep::solve_again(const World& world,
                               const ConstrainedVertices& constrained,
                               std::vector<Vec3>& end_positions,
                               std::vector<Vec3>& end_velocities,
                               std::span<Contact> contacts,
                               ImplicitReport& report) {
    contact_forces_.take(contacts);
    newton_iteration(constrained, false,
                     report); // what meets deforms cloth: linearised where it is now
    finish(world, constrained, end_positions, end_velocities, contacts, report);
}

void ImplicitStep::finish(const World& world,
                          const ConstrainedVertices& constrained,
                          std::vector<Vec3>& end_positions,
                          std::vector<Vec3>& end_velocities,
                          std::span<Contact> contacts,
                          ImplicitReport& report) const {
    end_velocities = v_;
    end_positions = x_;
    parallel_for(v_.size(), [&](std::size_t i) {
        if (constrained.flags[i] != 0) {
            end_positions[i] = constrained.targets[i];
            end_velocities[i] = (constrained.targets[i] - world.positions[i]) / dt_;
        }
    });
    contact_forces_.report(end_positions, contacts);
    if (!world.rigids.empty()) {
        project_rigids(world, end_positions, end_velocities);
        contact_forces_.report_slips(end_positions, contacts);
    }
    interpolate_embedded(world, end_positions);
    interpolate_embedded(world, end_velocities);
    report.converged = report.converged && all_finite(end_positions) && all_finite(end_velocities);
}

/// Rigid bodies start from where they get when no force acts; the solve adds to that motion.
void ImplicitStep::predict_rigids(const World& world, double dt) {
    for (const RigidBody& rigid : world.rigids) {
        const RigidPrediction prediction =
            predict_rigid(rigid.rest, particles_of(rigid, world.positions),
                          particles_of(rigid, world.velocities), dt);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t i = static_cast<std::size_t>(rigid.body.first_particle) + k;
            v_base_[i] = prediction.velocities[k];
            x_base_[i] = prediction.positions[k] - beta_ * v_base_[i];
            x_[i] = prediction.positions[k];
            v_[i] = v_base_[i];
            guess_[i].setZero();
        }
    }
}

void ImplicitStep::project_rigids(const World& world,
                                  std::span<Vec3> end_positions,
                                  std::span<Vec3> end_velocities) const {
    for (const RigidBody& rigid : world.rigids) {
        const auto first = static_cast<std::size_t>(rigid.body.first_particle);
        RigidPrediction prediction;
        for (std::size_t k = 0; k < 4; ++k) {
            prediction.velocities[k] = v_base_[first + k];
            prediction.positions[k] = x_base_[first + k] + beta_ * v_base_[first + k];
        }
        const RigidPrediction end =
            project_to_rigid(rigid.rest, prediction, particles_of(rigid, end_positions),
                             particles_of(rigid, end_velocities));
        std::copy(end.positions.begin(), end.positions.end(),
                  end_positions.begin() + rigid.body.first_particle);
        std::copy(end.velocities.begin(), end.velocities.end(),
                  end_velocities.begin() + rigid.body.first_particle);
    }
}

void ImplicitStep::start(const World& world, double dt) {
    dt_ = dt;
    const bool two_step = params_.integrator == Integrator::Bdf2 && world.history_dt == dt;
    beta_ = two_step ? 2.0 / 3.0 * dt : dt;
    parallel_for(v_.size(), [&](std::size_t i) {
        const Vec3& x = world.positions[i];
        const Vec3& v = world.velocities[i];
        x_base_[i] = two_step ? Vec3((4.0 * x - world.previous_positions[i]) / 3.0) : x;
        v_base_[i] = two_step ? Vec3((4.0 * v - world.previous_velocities[i]) / 3.0) : v;
        x_[i] = x;
        v_[i] = (x - x_base_[i]) / beta_; // linearised where the substep starts
        guess_[i] = v - v_[i];
    });
    assert(world.rigids.empty() || beta_ == dt);
    predict_rigids(world, dt);
    floor_ = params_.gravity.norm() * dt *
             std::sqrt(parallel_sum(masses_.size(),
                                    [&](std::size_t i) { return masses_[i] * masses_[i]; }));
}

/// One linearisation, balanced with contact; false when it was the last one needed or failed.
bool ImplicitStep::newton_iteration(const ConstrainedVertices& constrained,
                                    bool is_first,
                                    ImplicitReport& report) {
    linear_v_ = v_;
    linearise(constrained, is_first, report);
    if (is_first) {
        predict_ballistic(constrained);
    }
    const double slope = -dot(residual_, change_);
    balance(constrained, report);
    if (!report.converged) {
        return false;
    }
    ++report.newton_iterations;

    parallel_for(v_.size(), [&](std::size_t i) { change_[i] = v_[i] - linear_v_[i]; });
    if (!is_first) {
        const double alpha = line_search(linear_v_, slope);
        parallel_for(v_.size(), [&](std::size_t i) { v_[i] = linear_v_[i] + alpha * change_[i]; });
        move_to(v_, x_);
    }
    const double largest = std::sqrt(parallel_reduce(
        change_.size(), 0.0, [&](std::size_t i) { return change_[i].squaredNorm(); },
        [](double a, double b) { return std::max(a, b); }));
    constexpr double k_small_change = 1e-9; // m/s: a further iteration would change nothing visible
    return largest > k_small_change;
}

/// The linear step at (x_, v_), then (x_, v_) moved to the guess: where vertices go without new
/// forces, constrained ones to their targets.
void ImplicitStep::linearise(const ConstrainedVertices& constrained,
                             bool is_first,
                             ImplicitReport& report) {
    Stopwatch watch;
    forces_.evaluate(x_, v_, {beta_ * beta_, beta_}, force_);
    report.seconds_forces += watch.seconds();
    watch.restart();
    find_residual();
    parallel_for(v_.size(), [&](std::size_t i) {
        const Vec3 constrained_change = (constrained.targets[i] - x_base_[i]) / beta_ - v_[i];
        change_[i] = constrained.flags[i] != 0 ? constrained_change
                     : is_first                ? guess_[i]
                                               : Vec3(Vec3::Zero());
        diagonal_[i] = masses_[i] + beta_ * mass_damping_[i];
    });
    forces_.assemble(diagonal_, matrix_);
    to_rows(residual_, row_residual_);
    to_rows(change_, row_change_);
    multiply(matrix_, row_change_, row_product_);
    scale_ = std::max(eliminate_constrained(constrained), floor_);
    parallel_for(v_.size(), [&](std::size_t i) {
        v_[i] += change_[i];
        x_[i] = x_base_[i] + beta_ * v_[i];
    });
    report.seconds_assembly += watch.seconds();
}

LinearStep ImplicitStep::linear_step(const ConstrainedVertices& constrained) {
    return {&matrix_,
            forces_.assembler().row_of_vertex(),
            constrained.flags,
            beta_,
            params_.solver_tolerance * scale_,
            row_residual_,
            x_,
            v_};
}

/// The first guess: everything accelerates by the multiple of gravity that lowers the potential
/// most. That is all of it for cloth in the air, and nothing for cloth at rest.
void ImplicitStep::predict_ballistic(const ConstrainedVertices& constrained) {
    parallel_for(v_.size(), [&](std::size_t i) {
        trial_v_[i] = constrained.flags[i] != 0 ? Vec3(Vec3::Zero()) : params_.gravity;
    });
    to_rows(trial_v_, row_change_);
    const LinearStep step = linear_step(constrained);
    contact_forces_.fit_limits(x_);
    newton_.move_along(step, contact_forces_, row_change_);
}

void ImplicitStep::balance(const ConstrainedVertices& constrained, ImplicitReport& report) {
    const BalanceReport balance = newton_.solve(linear_step(constrained), contact_forces_);
    report.cg_iterations += balance.cg_iterations;
    report.contact_rounds += balance.rounds;
    report.residual = balance.imbalance / std::max(scale_, std::numeric_limits<double>::min());
    report.converged = balance.converged;
    report.seconds_assembly += balance.seconds_assembly;
    report.seconds_solve += balance.seconds_solve;
}

/// residual = -(M (v - v_base) - beta f), without contact, at (x_, v_): N s. force_ holds the
/// element forces.
void ImplicitStep::find_residual() {
    parallel_for(v_.size(), [&](std::size_t i) {
        const Vec3 force = force_[i] + masses_[i] * params_.gravity - mass_damping_[i] * v_[i];
        residual_[i] = beta_ * force - masses_[i] * (v_[i] - v_base_[i]);
    });
}

/// Takes the guess off the residual and makes the rows of constrained vertices the identity.
/// Returns the norm of the right-hand side when only constrained vertices have moved.
double ImplicitStep::eliminate_constrained(const ConstrainedVertices& constrained) {
    const auto rows = forces_.assembler().row_of_vertex();
    std::vector<Vec3>& right = row_right_;
    right = row_residual_;
    parallel_for(row_residual_.size(), [&](std::size_t r) { row_residual_[r] -= row_product_[r]; });
    for (std::size_t v = 0; v < constrained.flags.size(); ++v) {
        if (constrained.flags[v] == 0) {
            continue;
        }
        const auto r = static_cast<std::size_t>(rows[v]);
        for (Index k = matrix_.row_begin[r]; k < matrix_.row_begin[r + 1]; ++k) {
            const auto c = static_cast<std::size_t>(matrix_.column[static_cast<std::size_t>(k)]);
            if (c == r) {
                continue;
            }
            const Index mirror = find_block(matrix_, static_cast<Index>(c), static_cast<Index>(r));
            Mat3& across = matrix_.blocks[static_cast<std::size_t>(mirror)];
            right[c] -= across * row_change_[r];
            across.setZero();
            matrix_.blocks[static_cast<std::size_t>(k)].setZero();
        }
        matrix_.blocks[static_cast<std::size_t>(matrix_.diagonal[r])] =
            masses_[v] * Mat3::Identity();
    }
    for (std::size_t v = 0; v < constrained.flags.size(); ++v) {
        if (constrained.flags[v] !=
            0) { // after all moves: a constrained neighbour must not disturb it
            const auto r = static_cast<std::size_t>(rows[v]);
            right[r].setZero();
            row_residual_[r].setZero();
        }
    }
    return std::sqrt(dot(right, right));
}

/// Alpha in (0, 1] of the change, halved until the slope of the incremental potential along it,
/// which is change . gradient, has fallen far enough from its (negative) start.
double ImplicitStep::line_search(std::span<const Vec3> from, double slope_start) {
    const double enough = k_slope_fraction * std::abs(slope_start);
    return backtrack(1.0, k_most_alpha_halvings, [&](double alpha) {
        parallel_for(v_.size(), [&](std::size_t k) { trial_v_[k] = from[k] + alpha * change_[k]; });
        move_to(trial_v_, trial_x_);
        forces_.forces_only(trial_x_, trial_v_, force_);
        contact_forces_.add_forces(trial_x_, force_);
        const double slope = parallel_sum(v_.size(), [&](std::size_t k) {
            const Vec3 f =
                force_[k] + masses_[k] * params_.gravity - mass_damping_[k] * trial_v_[k];
            return change_[k].dot(masses_[k] * (trial_v_[k] - v_base_[k]) - beta_ * f);
        });
        return slope <= enough;
    });
}

void ImplicitStep::move_to(std::span<const Vec3> velocities, std::span<Vec3> positions) const {
    parallel_for(positions.size(),
                 [&](std::size_t i) { positions[i] = x_base_[i] + beta_ * velocities[i]; });
}

void ImplicitStep::to_rows(std::span<const Vec3> by_vertex, std::span<Vec3> by_row) const {
    const auto rows = forces_.assembler().row_of_vertex();
    parallel_for(by_vertex.size(), [&](std::size_t v) {
        if (rows[v] != k_no_index) {
            by_row[static_cast<std::size_t>(rows[v])] = by_vertex[v];
        }
    });
}

} // namespace weft
