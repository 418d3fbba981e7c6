#pragma once

#include "scene/params.h"
#include "state/world.h"
#include "step/constrained_vertices.h"
#include "step/contact_newton.h"
#include "step/force_system.h"

namespace weft {

/// What one implicit step did.
struct ImplicitReport {
    int cg_iterations = 0;
    int newton_iterations = 0;
    int contact_rounds = 0;
    double residual = 0.0;  ///< relative, of the last balance
    bool converged = false; ///< false also when something is not finite
    double seconds_forces = 0.0, seconds_assembly = 0.0, seconds_solve = 0.0;
};

/// Step 2 of a substep: the continuum model alone, all deformables in one block system.
///
/// Both integrators solve, for the end velocity v+, with x(v) = x_base + beta v,
///
///     M (v+ - v_base) = beta f(x(v+), v+)
///
///     implicit Euler   beta = dt       v_base = v               x_base = x
///     BDF2             beta = 2 dt/3   v_base = (4 v - v-)/3    x_base = (4 x - x-)/3
///
/// by Newton's method from x(v+) = x, with A = M + beta D + beta^2 K. One iteration of implicit
/// Euler is the linearised step of Baraff and Witkin 1998 and of Bender and Deul 2013. Constrained
/// vertices are eliminated (rows and columns of A become the identity); embedded ones follow their
/// particles.
///
/// For rigid bodies, which need implicit Euler, v_base and x_base are those of their free motion
/// (rigid_prediction.h), and the result is projected to a rigid motion.
class ImplicitStep {
public:
    ImplicitStep(const World& world, const SceneParams& params);

    /// Follows the cloths through a change of their meshes. Everything is then as if made of the
    /// world as it is now.
    /// @param changes  of each cloth, since the last call or the construction
    void remesh(const World& world, std::span<const ClothChanges> changes);

    /// Position and velocity at the end of a substep of length dt (s) with the given contacts; the
    /// world is not changed. Contacts receive their impulses and slips.
    ImplicitReport solve(const World& world,
                         const ConstrainedVertices& constrained,
                         double dt,
                         std::vector<Vec3>& end_positions,
                         std::vector<Vec3>& end_velocities,
                         std::span<Contact> contacts = {});

    /// The same substep from where the last call left it, with contacts appended to its list. Adds
    /// to the report.
    void solve_again(const World& world,
                     const ConstrainedVertices& constrained,
                     std::vector<Vec3>& end_positions,
                     std::vector<Vec3>& end_velocities,
                     std::span<Contact> contacts,
                     ImplicitReport& report);

private:
    void resize(const World& world);
    void start(const World& world, double dt);
    void predict_rigids(const World& world, double dt);
    void project_rigids(const World& world,
                        std::span<Vec3> end_positions,
                        std::span<Vec3> end_velocities) const;
    void finish(const World& world,
                const ConstrainedVertices& constrained,
                std::vector<Vec3>& end_positions,
                std::vector<Vec3>& end_velocities,
                std::span<Contact> contacts,
                ImplicitReport& report) const;
    bool
    newton_iteration(const ConstrainedVertices& constrained, bool is_first, ImplicitReport& report);
    void linearise(const ConstrainedVertices& constrained, bool is_first, ImplicitReport& report);
    void balance(const ConstrainedVertices& constrained, ImplicitReport& report);
    void predict_ballistic(const ConstrainedVertices& constrained);
    void find_residual();
    double eliminate_constrained(const ConstrainedVertices& constrained);
    LinearStep linear_step(const ConstrainedVertices& constrained);
    double line_search(std::span<const Vec3> from, double slope_start);
    void move_to(std::span<const Vec3> velocities, std::span<Vec3> positions) const;
    void to_rows(std::span<const Vec3> by_vertex, std::span<Vec3> by_row) const;

    SceneParams params_;
    std::vector<double> masses_;
    std::vector<double> mass_damping_; ///< #V, alpha * m, kg/s
    ForceSystem forces_;
    ContactForces contact_forces_;
    BlockMatrix matrix_;
    ContactNewton newton_;

    double dt_ = 0.0;
    double beta_ = 0.0;
    double floor_ = 0.0; ///< least scale of the balance: impulse of gravity over a substep, N s
    double scale_ = 0.0; ///< norm that the balance is relative to, N s
    std::vector<Vec3> x_base_, v_base_, guess_;
    std::vector<Vec3> x_, v_, force_, residual_, change_; ///< the current iterate, by vertex
    std::vector<Vec3> linear_v_, trial_x_, trial_v_;
    std::vector<Vec3> row_residual_, row_change_, row_product_, row_right_;
    std::vector<double> diagonal_;
};

} // namespace weft
