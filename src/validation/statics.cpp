#include "validation/statics.h"

#include "base/error.h"
#include "base/line_search.h"
#include "step/force_system.h"
#include "validation/experiment_world.h"

#include <Eigen/SparseCholesky>

#include <cmath>

namespace weft {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

Eigen::VectorXd flatten(std::span<const Vec3> values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data()->data(),
                                             static_cast<Eigen::Index>(3 * values.size()));
}

/// Elements and matrix of a world, between the iterations of one calculation.
class StaticSystem {
public:
    StaticSystem(const World& world, const SceneParams& params)
        : elements_(world, params), matrix_(elements_.assembler().pattern()),
          at_rest_(world.vertex_count(), Vec3::Zero()), forces_(world.vertex_count()) {}

    Eigen::VectorXd forces(std::span<const Vec3> x) {
        elements_.forces_only(x, at_rest_, forces_);
        return flatten(forces_);
    }

    /// K + diagonal (N/m, by vertex).
    Sparse stiffness(std::span<const Vec3> x, std::span<const double> diagonal) {
        elements_.evaluate(x, at_rest_, {1.0, 0.0}, forces_);
        elements_.assemble(diagonal, matrix_);
        const auto rows = elements_.assembler().row_of_vertex();
        std::vector<Index> vertex(rows.size());
        for (std::size_t v = 0; v < rows.size(); ++v) {
            vertex[static_cast<std::size_t>(rows[v])] = static_cast<Index>(v);
        }
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(9 * matrix_.blocks.size());
        for (std::size_t r = 0; r < matrix_.rows(); ++r) {
            for (Index k = matrix_.row_begin[r]; k < matrix_.row_begin[r + 1]; ++k) {
                const auto place = static_cast<std::size_t>(k);
                const Index c = vertex[static_cast<std::size_t>(matrix_.column[place])];
                for (int i = 0; i < 9; ++i) {
                    entries.emplace_back(3 * vertex[r] + i / 3, 3 * c + i % 3,
                                         matrix_.blocks[place](i / 3, i % 3));
                }
            }
        }
        const auto size = static_cast<Eigen::Index>(3 * rows.size());
        Sparse result(size, size);
        result.setFromTriplets(entries.begin(), entries.end());
        return result;
    }

private:
    ForceSystem elements_;
    BlockMatrix matrix_;
    std::vector<Vec3> at_rest_, forces_;
};

/// Solves systems of one pattern with the rows and columns of held components removed; finds the
/// order of elimination once.
class FreeSolver {
public:
    explicit FreeSolver(const std::vector<char>& held) : held_(held) {}

    /// @param given  values of the held components
    Eigen::VectorXd
    solve(const Sparse& matrix, const Eigen::VectorXd& rhs, const Eigen::VectorXd& given) {
        Eigen::VectorXd known = rhs - matrix * given;
        Sparse reduced = matrix;
        for (Eigen::Index c = 0; c < reduced.cols(); ++c) {
            for (Sparse::InnerIterator entry(reduced, c); entry; ++entry) {
                if (is_held(entry.row()) || is_held(c)) {
                    entry.valueRef() = entry.row() == c ? 1.0 : 0.0;
                }
            }
            if (is_held(c)) {
                known[c] = given[c];
            }
        }
        if (!is_analysed_) {
            cholesky_.analyzePattern(reduced);
            is_analysed_ = true;
        }
        cholesky_.factorize(reduced);
        if (cholesky_.info() != Eigen::Success) {
            throw Error(ExitCode::Diverged, "the stiffness matrix is singular");
        }
        return cholesky_.solve(known);
    }

private:
    bool is_held(Eigen::Index i) const { return held_[static_cast<std::size_t>(i)] != 0; }

    std::vector<char> held_;
    Eigen::SimplicialLDLT<Sparse> cholesky_;
    bool is_analysed_ = false;
};

void clear_held(const std::vector<char>& held, Eigen::VectorXd& values) {
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (held[i] != 0) {
            values[static_cast<Eigen::Index>(i)] = 0.0;
        }
    }
}

std::vector<Vec3> moved(std::span<const Vec3> x, const Eigen::VectorXd& change, double length) {
    std::vector<Vec3> result(x.begin(), x.end());
    for (std::size_t i = 0; i < x.size(); ++i) {
        result[i] += length * change.segment<3>(static_cast<Eigen::Index>(3 * i));
    }
    return result;
}

double largest_move(const Eigen::VectorXd& change) {
    return change.reshaped(3, change.size() / 3).colwise().norm().maxCoeff();
}

/// Mean of a component of u over vertices.
double mean(const Eigen::VectorXd& u, std::span<const Index> vertices, int component) {
    double sum = 0.0;
    for (const Index v : vertices) {
        sum += u[3 * v + component];
    }
    return sum / static_cast<double>(vertices.size());
}

} // namespace

StaticLoad::StaticLoad(std::size_t vertex_count) : held(3 * vertex_count, 0) {
    given.setZero(static_cast<Eigen::Index>(held.size()));
    force.setZero(static_cast<Eigen::Index>(held.size()));
}

void StaticLoad::hold(Index vertex, int component, double displacement) {
    held[static_cast<std::size_t>(3 * vertex + component)] = 1;
    given[3 * vertex + component] = displacement;
}

void StaticLoad::hold(Index vertex) {
    for (int component = 0; component < 3; ++component) {
        hold(vertex, component);
    }
}

void StaticLoad::hold_all(int component) {
    for (Index v = 0; v < static_cast<Index>(held.size() / 3); ++v) {
        hold(v, component);
    }
}

void StaticLoad::add(Index vertex, const Vec3& force_added) {
    force.segment<3>(3 * vertex) += force_added;
}

Eigen::VectorXd element_forces(const World& world, const SceneParams& params) {
    return StaticSystem(world, params).forces(world.positions);
}

Sparse stiffness_matrix(const World& world, const SceneParams& params) {
    const std::vector<double> nothing(world.vertex_count(), 0.0);
    return StaticSystem(world, params).stiffness(world.positions, nothing);
}

Eigen::MatrixXd transverse_stiffness(const World& world, const SceneParams& params, double step) {
    StaticSystem system(world, params);
    const auto count = static_cast<Eigen::Index>(world.vertex_count());
    Eigen::MatrixXd result(count, count);
    std::vector<Vec3> x = world.positions;
    for (Eigen::Index i = 0; i < count; ++i) {
        double& z = x[static_cast<std::size_t>(i)].z();
        const double start = z;
        z = start + step;
        const Eigen::VectorXd above = system.forces(x);
        z = start - step;
        const Eigen::VectorXd below = system.forces(x);
        z = start;
        result.col(i) = ((below - above) / (2.0 * step)).reshaped(3, count).row(2).transpose();
    }
    return 0.5 * (result + result.transpose());
}

Eigen::VectorXd linear_response(const Sparse& stiffness, const StaticLoad& load) {
    return FreeSolver(load.held).solve(stiffness, load.force, load.given);
}

SettleReport
settle(World& world, const SceneParams& params, const StaticLoad& load, const SettleParams& how) {
    StaticSystem system(world, params);
    Eigen::VectorXd external = load.force;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        external.segment<3>(static_cast<Eigen::Index>(3 * i)) += world.masses[i] * params.gravity;
    }
    clear_held(load.held, external);
    double load_size = 0.0; // with the reactions of what is held
    const auto unbalanced = [&](std::span<const Vec3> x) {
        Eigen::VectorXd force = system.forces(x) + external;
        const double whole = force.squaredNorm();
        clear_held(load.held, force);
        load_size = external.norm() + std::sqrt(std::max(0.0, whole - force.squaredNorm()));
        return force;
    };
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(external.size());
    FreeSolver solver(load.held);
    SettleReport report;
    double mobility = how.first_mobility;
    Eigen::VectorXd residual = unbalanced(world.positions);
    std::vector<double> diagonal(world.vertex_count());
    for (; report.iterations < how.max_iterations; ++report.iterations) {
        report.residual = residual.norm() / load_size;
        if (report.residual <= how.tolerance) {
            return report;
        }
        for (std::size_t i = 0; i < diagonal.size(); ++i) {
            diagonal[i] = world.masses[i] / mobility;
        }
        const Sparse matrix = system.stiffness(world.positions, diagonal);
        const Eigen::VectorXd change = solver.solve(matrix, residual, nothing);
        const double slope = residual.dot(change);
        const double longest = std::min(1.0, how.max_step / largest_move(change));
        const double alpha = backtrack(longest, 30, [&](double trial) {
            const std::vector<Vec3> x = moved(world.positions, change, trial);
            const Eigen::VectorXd force = unbalanced(x);
            if (-force.dot(change) > k_slope_fraction * slope) {
                return false;
            }
            world.positions = x;
            residual = force;
            return true;
        });
        mobility *= alpha == 1.0 ? 4.0 : alpha > 0.2 ? 1.0 : 0.25;
    }
    throw Error(ExitCode::Diverged,
                fmt::format("no equilibrium after {} iterations: unbalanced force {:.3g} of the "
                            "load; must be <= {:.3g}",
                            report.iterations, report.residual, how.tolerance));
}

Elasticity tensile_test(const Sheet& sheet, const Eigen::SparseMatrix<double>& stiffness) {
    const auto side = [&](int axis, double at) {
        return vertices_where(sheet, [=](const Vec2& p) { return std::abs(p[axis] - at) < 1e-9; });
    };
    const std::vector<Index> left = side(0, 0.0);
    const std::vector<Index> right = side(0, 1.0);
    StaticLoad load(sheet.points.size());
    load.hold_all(2);
    for (const Index v : left) {
        load.hold(v, 0);
    }
    for (const Index v : right) {
        load.hold(v, 0, 1.0);
    }
    load.hold(left.front(), 1);
    const Eigen::VectorXd u = linear_response(stiffness, load);
    const Eigen::VectorXd force = stiffness * u;
    return {mean(force, right, 0) * static_cast<double>(right.size()),
            mean(u, side(1, 0.0), 1) - mean(u, side(1, 1.0), 1)};
}

} // namespace weft
