#pragma once

#include "geometry/shapes.h"
#include "state/world.h"

#include <Eigen/Dense>
#include <Eigen/SparseCore>

namespace weft {

/// What acts on a world at rest, by component: 3 #V long, vertex by vertex.
struct StaticLoad {
    std::vector<char> held; ///< 1: the component stays (settle) or is given (linear_response)
    Eigen::VectorXd given;  ///< displacement of held components in linear_response, m
    Eigen::VectorXd force;  ///< dead load, N; gravity is apart

    explicit StaticLoad(std::size_t vertex_count);
    void hold(Index vertex, int component, double displacement = 0.0);
    void hold(Index vertex); ///< all three
    void hold_all(int component);
    void add(Index vertex, const Vec3& force_added);
};

/// Forces of the cloth's elements at its present positions, N, 3 #V.
Eigen::VectorXd element_forces(const World& world, const SceneParams& params);

/// K = -df/dx of all elements at the present positions as the simulation has it (positive
/// semidefinite), N/m, 3 #V squared.
Eigen::SparseMatrix<double> stiffness_matrix(const World& world, const SceneParams& params);

/// -df_z/dz of the elements, #V squared, N/m: by differences of the forces and so with the
/// softening of compressed elements, which the simulation's own matrix leaves out.
/// @param step  m; its square over that of an edge must be small against the strain
Eigen::MatrixXd transverse_stiffness(const World& world, const SceneParams& params, double step);

/// Displacements u of K u = force for the free components, the held ones as given, m.
/// Throws Error (Diverged) when K is singular.
Eigen::VectorXd linear_response(const Eigen::SparseMatrix<double>& stiffness,
                                const StaticLoad& load);

struct SettleParams {
    double tolerance = 1e-9; ///< |unbalanced force| / |load and reactions| at the end
    int max_iterations = 2000;
    double first_mobility = 1e-2; ///< s^2; how soft the start is, dt^2 of a first implicit step
    double max_step = k_forever;  ///< m; no vertex moves further in one iteration
};

struct SettleReport {
    int iterations = 0;
    double residual = 0.0; ///< as in tolerance
};

/// Moves the world to a stable equilibrium of its elements, gravity (params.gravity) and the load:
/// Newton iterations with a direct solve, held back by the masses (pseudo-transient continuation)
/// as much as the line search asks. Throws Error (Diverged) when it does not get there.
SettleReport settle(World& world,
                    const SceneParams& params,
                    const StaticLoad& load,
                    const SettleParams& how = {});

/// What a tensile test returns.
struct Elasticity {
    double modulus; ///< E, N/m
    double poisson; ///< nu
};

/// Small uniaxial extension of a unit square along x: its left and right sides are moved apart and
/// slide freely along themselves, the others are free.
///
/// @param stiffness  3 #V squared, N/m, of any model of the sheet; z is not used
Elasticity tensile_test(const Sheet& sheet, const Eigen::SparseMatrix<double>& stiffness);

} // namespace weft
