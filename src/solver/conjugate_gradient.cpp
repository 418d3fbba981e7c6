#include "solver/conjugate_gradient.h"

#include "base/parallel.h"

#include <cmath>

namespace weft {

CgReport ConjugateGradient::solve(const BlockMatrix& matrix,
                                  const Precondition& precondition,
                                  std::span<const Vec3> b,
                                  std::span<Vec3> x,
                                  const CgParams& params) {
    const std::size_t n = matrix.rows();
    residual_.resize(n);
    direction_.resize(n);
    product_.resize(n);
    preconditioned_.resize(n);
    const double scale = std::max(std::sqrt(dot(b, b)), params.floor);
    CgReport report;
    if (scale == 0.0) {
        parallel_for(n, [&](std::size_t i) { x[i].setZero(); });
        report.converged = true;
        return report;
    }

    multiply(matrix, x, residual_);
    parallel_for(n, [&](std::size_t i) { residual_[i] = b[i] - residual_[i]; });
    precondition(residual_, preconditioned_);
    direction_ = preconditioned_;
    double r_z = dot(residual_, preconditioned_);
    double r_r = dot(residual_, residual_);
    while (true) {
        report.residual = std::sqrt(r_r) / scale;
        report.converged = report.residual <= params.tolerance;
        if (report.converged || report.iterations >= params.max_iterations ||
            !std::isfinite(report.residual)) {
            return report;
        }
        multiply(matrix, direction_, product_);
        const double curvature = dot(direction_, product_);
        if (!(curvature > 0.0)) {
            return report;
        }
        const double alpha = r_z / curvature;
        r_r = parallel_sum(n, [&](std::size_t i) {
            x[i] += alpha * direction_[i];
            residual_[i] -= alpha * product_[i];
            return residual_[i].squaredNorm();
        });
        precondition(residual_, preconditioned_);
        const double r_z_next = dot(residual_, preconditioned_);
        const double beta = r_z_next / r_z;
        r_z = r_z_next;
        parallel_for(
            n, [&](std::size_t i) { direction_[i] = preconditioned_[i] + beta * direction_[i]; });
        ++report.iterations;
    }
}

} // namespace weft
