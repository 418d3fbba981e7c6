#pragma once

#include "solver/conjugate_gradient.h"
#include "solver/preconditioner.h"
#include "step/contact_forces.h"

namespace weft {

/// A linearised step, by row of its matrix. The equation that is left to balance is
///
///     residual + beta f_contact(x) = 0,    residual = r - A c,    x = x_base + beta (v + c)
///
/// and a further change d of velocities takes A d from `residual` and adds beta d to x. Rows of
/// constrained vertices are the identity and their residual is zero; embedded ones have no row, and
/// stay.
struct LinearStep {
    const BlockMatrix* matrix;
    std::span<const Index> row_of_vertex; ///< k_no_index: embedded
    std::span<const char> constrained;    ///< by vertex
    double beta;                          ///< s
    double tolerance;                     ///< norm of the imbalance to stop at, N s
    std::span<Vec3> residual;             ///< by row, N s
    std::span<Vec3> x;                    ///< by vertex: where vertices end, m
    std::span<Vec3> v;                    ///< by vertex: with which velocity, m/s

    bool moves(std::size_t v) const {
        return constrained[v] == 0 && row_of_vertex[v] != k_no_index;
    }
};

/// What a balance took.
struct BalanceReport {
    int rounds = 0;
    int cg_iterations = 0;
    double imbalance = 0.0; ///< N s, at the end
    bool converged = false; ///< all linear solves
    double seconds_assembly = 0.0, seconds_solve = 0.0;
};

/// Balances a linearised step with contact. With the friction limits fixed, both have one convex
/// potential, which each round lowers by one step of Newton's method with an exact line search
/// (along a line the step is a parabola, and contact costs one pass over the contacts). Each round
/// first fits the limits to the normal forces, and solves only as well as it takes (inexact
/// Newton).
class ContactNewton {
public:
    /// Forgets the pattern of the matrices, which otherwise must never change.
    void reset();

    /// Takes a step from where it stands to the balance. Deterministic.
    BalanceReport solve(const LinearStep& step, ContactForces& contact);

    /// Moves along `direction` (by row, 0 for constrained rows) as far as lowers the potential
    /// most. Returns the multiple of the direction.
    double
    move_along(const LinearStep& step, ContactForces& contact, std::span<const Vec3> direction);

private:
    void keep_momentum(const LinearStep& step, const ContactForces& contact);
    double find_imbalance(const LinearStep& step, const ContactForces& contact);
    bool find_direction(const LinearStep& step,
                        ContactForces& contact,
                        double forcing,
                        BalanceReport& report);
    const BlockMatrix&
    build_matrix(const LinearStep& step, ContactForces& contact, BalanceReport& report);
    void build_coarse_space(const LinearStep& step, const BlockMatrix& matrix);

    CoupledMatrix coupled_;
    IncompleteCholesky preconditioner_;
    CoarseSpace coarse_;
    bool is_coarse_cut_ = false;   ///< the patches are of the present pattern
    bool is_coarse_built_ = false; ///< its system is of the present step
    ConjugateGradient cg_;
    bool was_coupled_ = false;
    double damping_ = 0.0; ///< friction damping in this round, see FrictionLaw
    int revision_ = -1;    ///< revision of the contacts whose blocks are coupled
    std::vector<BlockEntry> joined_;
    std::vector<Vec3> row_positions_;                   ///< by row
    std::vector<char> fixed_;                           ///< by row
    std::vector<Vec3> imbalance_, direction_, product_; ///< by row
    std::vector<Vec3> forces_, motion_;                 ///< by vertex
};

} // namespace weft
