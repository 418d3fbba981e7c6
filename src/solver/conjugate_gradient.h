#pragma once

#include "solver/block_matrix.h"

#include <functional>

namespace weft {

/// When to stop: at |r| <= tolerance * max(|b|, floor), or after `max_iterations`.
struct CgParams {
    double tolerance = 1e-4;
    double floor = 0.0; ///< in the unit of b: below it a right-hand side counts as noise
    int max_iterations = 10000;
};

struct CgReport {
    int iterations = 0;
    double residual = 0.0; ///< |r| / max(|b|, floor) at the end
    bool converged = false;
};

/// z ~ A^-1 r, symmetric and positive.
using Precondition = std::function<void(std::span<const Vec3> r, std::span<Vec3> z)>;

/// Preconditioned conjugate gradients for symmetric positive definite systems; sums in a fixed
/// order. Keeps its vectors between calls.
class ConjugateGradient {
public:
    /// Solves A x = b from the given x. Not finite or indefinite systems return converged = false.
    CgReport solve(const BlockMatrix& matrix,
                   const Precondition& precondition,
                   std::span<const Vec3> b,
                   std::span<Vec3> x,
                   const CgParams& params);

private:
    std::vector<Vec3> residual_, direction_, product_, preconditioned_;
};

} // namespace weft
