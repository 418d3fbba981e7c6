#include "step/contact_newton.h"

#include "base/line_search.h"
#include "base/parallel.h"
#include "base/stopwatch.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

/// Rounds at most. What is not balanced then is small, and is balanced in the next substep. More:
/// contacts that hand load to and fro cost time; fewer: friction fits its normal load less well.
constexpr int k_most_rounds = 24;

/// How much better each round's linear solve makes the balance: half of what the last round did,
/// as what is solved better than the contacts still change is wasted (Eisenstat and Walker 1996);
/// but well where a round brought little, for which a poor direction may be to blame.
constexpr double k_first_forcing = 0.2;
constexpr double k_little = 0.5;
constexpr double k_least_forcing = 0.03;
constexpr double k_greatest_forcing = 0.3;

/// Iterations without the coarse space. A solve that ends within them would not pay for it.
constexpr int k_fine_iterations = 24;

/// A step along a direction ends where the slope of the potential is this fraction of its start.
constexpr double k_slope_left = 0.1;

/// A round that stepped by less than this alpha met friction that its tangent did not see; the
/// friction tangent of the next round is damped, and that of later ones less and less.
constexpr double k_short_step = 0.3;
constexpr double k_damping_kept = 0.5;

} // namespace

void ContactNewton::reset() {
    coupled_.reset();
    preconditioner_.reset();
    revision_ = -1;
    is_coarse_cut_ = false;
}

/// imbalance_ = residual + beta f_contact; returns its norm.
double ContactNewton::find_imbalance(const LinearStep& step, const ContactForces& contact) {
    imbalance_.assign(step.residual.begin(), step.residual.end());
    if (!contact.empty()) {
        forces_.assign(step.x.size(), Vec3::Zero());
        contact.add_forces(step.x, forces_);
        parallel_for(forces_.size(), [&](std::size_t v) {
            if (step.moves(v)) {
                imbalance_[at(step.row_of_vertex[v])] += step.beta * forces_[v];
            }
        });
    }
    return std::sqrt(dot(imbalance_, imbalance_));
}

/// The step's matrix, with what contacts add.
const BlockMatrix&
ContactNewton::build_matrix(const LinearStep& step, ContactForces& contact, BalanceReport& report) {
    const Stopwatch watch;
    const bool coupled = !contact.empty();
    bool same_pattern = coupled == was_coupled_;
    if (coupled) {
        if (contact.revision() != revision_) {
            revision_ = contact.revision();
            contact.list_blocks(step.row_of_vertex, joined_);
            same_pattern = !coupled_.couple(*step.matrix, joined_) && same_pattern;
            contact.find_blocks(step.row_of_vertex, step.constrained, coupled_.matrix());
        }
        coupled_.load(*step.matrix);
        contact.add_blocks(step.x, step.beta * step.beta, damping_, coupled_.matrix());
    }
    if (!same_pattern) {
        preconditioner_.reset();
    }
    was_coupled_ = coupled;
    report.seconds_assembly += watch.seconds();
    return coupled ? coupled_.matrix() : *step.matrix;
}

/// Once a step: contacts that change from round to round change it little.
void ContactNewton::build_coarse_space(const LinearStep& step, const BlockMatrix& matrix) {
    if (!is_coarse_cut_) {
        coarse_.set_pattern(*step.matrix);
        is_coarse_cut_ = true;
    }
    row_positions_.resize(step.residual.size());
    fixed_.resize(step.residual.size());
    parallel_for(step.x.size(), [&](std::size_t v) {
        if (step.row_of_vertex[v] == k_no_index) {
            return;
        }
        row_positions_[at(step.row_of_vertex[v])] = step.x[v];
        fixed_[at(step.row_of_vertex[v])] = step.constrained[v];
    });
    coarse_.build(matrix, row_positions_, fixed_);
    is_coarse_built_ = true;
}

bool ContactNewton::find_direction(const LinearStep& step,
                                   ContactForces& contact,
                                   double forcing,
                                   BalanceReport& report) {
    const BlockMatrix& matrix = build_matrix(step, contact, report);
    const Stopwatch watch;
    preconditioner_.factor(matrix);
    const double target = contact.empty()
                              ? 0.9 * step.tolerance
                              : std::max(0.5 * step.tolerance, forcing * report.imbalance);
    direction_.assign(imbalance_.size(), Vec3::Zero());
    const auto precondition = [&](std::span<const Vec3> r, std::span<Vec3> z) {
        preconditioner_.apply(r, z);
        if (is_coarse_built_) {
            coarse_.add_correction(r, z);
        }
    };
    CgParams params{.tolerance = target / report.imbalance};
    const int most = params.max_iterations;
    params.max_iterations = is_coarse_built_ ? most : k_fine_iterations;
    CgReport cg = cg_.solve(matrix, precondition, imbalance_, direction_, params);
    report.cg_iterations += cg.iterations;
    if (!cg.converged && cg.iterations == k_fine_iterations && !is_coarse_built_) {
        build_coarse_space(step, matrix);
        params.max_iterations = most;
        cg = cg_.solve(matrix, precondition, imbalance_, direction_, params);
        report.cg_iterations += cg.iterations;
    }
    report.seconds_solve += watch.seconds();
    return cg.converged;
}

double ContactNewton::move_along(const LinearStep& step,
                                 ContactForces& contact,
                                 std::span<const Vec3> direction) {
    product_.resize(direction.size());
    multiply(*step.matrix, direction, product_);
    motion_.resize(step.x.size());
    parallel_for(motion_.size(), [&](std::size_t v) {
        const Index row = step.row_of_vertex[v];
        motion_[v] = row == k_no_index ? Vec3(Vec3::Zero()) : Vec3(step.beta * direction[at(row)]);
    });
    const double slope = -dot(step.residual, direction);
    const double curvature = dot(direction, product_);
    if (!(curvature > 0.0)) {
        return 0.0;
    }
    contact.trace(step.x, motion_);
    const auto slope_at = [&](double alpha) {
        return slope + alpha * curvature - contact.work_along(alpha);
    };
    const double alpha =
        contact.empty() ? -slope / curvature : find_minimum(slope_at, k_slope_left);
    parallel_for(motion_.size(), [&](std::size_t v) {
        if (step.row_of_vertex[v] == k_no_index) {
            return;
        }
        const std::size_t row = at(step.row_of_vertex[v]);
        step.x[v] += alpha * motion_[v];
        step.v[v] += alpha * direction[row];
        step.residual[row] -= alpha * product_[row];
    });
    return alpha;
}

/// What moves freely keeps its momentum to the last bits, however well the solves were ended: the
/// imbalance that is left as a whole goes into a translation, which strains nothing.
void ContactNewton::keep_momentum(const LinearStep& step, const ContactForces& contact) {
    const bool free =
        std::find(step.constrained.begin(), step.constrained.end(), 1) == step.constrained.end();
    if (!free || !contact.is_internal()) {
        return;
    }
    find_imbalance(step, contact);
    const auto add = [](const auto& a, const auto& b) { return (a + b).eval(); };
    const Vec3 left = parallel_reduce(
        imbalance_.size(), Vec3(Vec3::Zero()), [&](std::size_t r) { return imbalance_[r]; }, add);
    const Mat3 inertia = parallel_reduce(
        step.matrix->blocks.size(), Mat3(Mat3::Zero()),
        [&](std::size_t k) { return step.matrix->blocks[k]; }, add);
    const Vec3 change = inertia.ldlt().solve(left);
    parallel_for(step.v.size(), [&](std::size_t v) {
        step.v[v] += change;
        step.x[v] += step.beta * change;
    });
    direction_.assign(imbalance_.size(), change);
    product_.resize(imbalance_.size());
    multiply(*step.matrix, direction_, product_);
    parallel_for(product_.size(), [&](std::size_t r) { step.residual[r] -= product_[r]; });
}

BalanceReport ContactNewton::solve(const LinearStep& step, ContactForces& contact) {
    BalanceReport report;
    double forcing = k_first_forcing;
    damping_ = 0.0;
    is_coarse_built_ = false;
    while (true) {
        const bool is_last = report.rounds == k_most_rounds; // only tells how well it balances
        if (!is_last) {
            contact.fit_limits(step.x);
        }
        const double before = report.imbalance;
        report.imbalance = find_imbalance(step, contact);
        if (report.rounds > 0) {
            const double left = report.imbalance / before;
            forcing = left > k_little ? k_least_forcing
                                      : std::clamp(0.5 * left, k_least_forcing, k_greatest_forcing);
        }
        report.converged = std::isfinite(report.imbalance);
        if (!report.converged || report.imbalance <= step.tolerance || is_last) {
            break;
        }
        if (!find_direction(step, contact, forcing, report)) {
            report.converged = false;
            break;
        }
        const double alpha = move_along(step, contact, direction_);
        damping_ = alpha < k_short_step ? 1.0 : k_damping_kept * damping_;
        ++report.rounds;
    }
    if (report.converged) {
        keep_momentum(step, contact);
    }
    return report;
}

} // namespace weft
