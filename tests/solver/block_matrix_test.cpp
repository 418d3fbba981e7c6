#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "solver/block_matrix.h"
#include "solver/conjugate_gradient.h"
#include "solver/preconditioner.h"

namespace weft {

namespace {

/// A random symmetric positive definite block matrix on a ring of rows with some chords.
BlockMatrix random_matrix(std::size_t rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<BlockEntry> entries;
    for (std::size_t r = 0; r < rows; ++r) {
        entries.push_back({static_cast<Index>(r), static_cast<Index>((r + 1) % rows)});
        entries.push_back({static_cast<Index>(r), static_cast<Index>((7 * r + 3) % rows)});
    }
    BlockMatrix matrix = make_pattern(rows, entries);
    for (std::size_t r = 0; r < rows; ++r) {
        for (Index k = matrix.diagonal[r]; k < matrix.row_begin[r + 1]; ++k) {
            const Index c = matrix.column[static_cast<std::size_t>(k)];
            Mat3 block = Mat3::NullaryExpr([&] { return value(random); });
            if (c == static_cast<Index>(r)) {
                block = 0.5 * (block + block.transpose()).eval() + 20.0 * Mat3::Identity();
            }
            matrix.blocks[static_cast<std::size_t>(k)] = block;
            matrix.blocks[static_cast<std::size_t>(find_block(matrix, c, static_cast<Index>(r)))] =
                block.transpose();
        }
    }
    return matrix;
}

Eigen::MatrixXd to_dense(const BlockMatrix& matrix) {
    const auto n = static_cast<Eigen::Index>(3 * matrix.rows());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t r = 0; r < matrix.rows(); ++r) {
        for (Index k = matrix.row_begin[r]; k < matrix.row_begin[r + 1]; ++k) {
            dense.block<3, 3>(static_cast<Eigen::Index>(3 * r),
                              3 * matrix.column[static_cast<std::size_t>(k)]) =
                matrix.blocks[static_cast<std::size_t>(k)];
        }
    }
    return dense;
}

Eigen::VectorXd flatten(const std::vector<Vec3>& x) {
    return Eigen::Map<const Eigen::VectorXd>(x[0].data(), static_cast<Eigen::Index>(3 * x.size()));
}

std::vector<Vec3> random_vector(std::size_t rows, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<Vec3> x(rows);
    for (Vec3& entry : x) {
        entry = Vec3(value(random), value(random), value(random));
    }
    return x;
}

} // namespace

TEST(BlockMatrix, ProductEqualsTheDenseProduct) {
    const BlockMatrix matrix = random_matrix(50, 1);
    const std::vector<Vec3> x = random_vector(50, 2);
    std::vector<Vec3> y(50);

    multiply(matrix, x, y);

    EXPECT_LT((flatten(y) - to_dense(matrix) * flatten(x)).norm(), 1e-12);
}

TEST(BlockMatrix, LocalityOrderIsAPermutationThatKeepsNeighboursClose) {
    constexpr Index n = 20; // a grid numbered at random
    std::vector<Index> name(static_cast<std::size_t>(n * n));
    std::iota(name.begin(), name.end(), 0);
    std::shuffle(name.begin(), name.end(), std::mt19937(3));
    std::vector<BlockEntry> entries;
    for (Index i = 0; i < n * n; ++i) {
        const auto at = [&](Index k) { return name[static_cast<std::size_t>(k)]; };
        if (i % n + 1 < n) {
            entries.push_back({at(i), at(i + 1)});
        }
        if (i + n < n * n) {
            entries.push_back({at(i), at(i + n)});
        }
    }

    const BlockMatrix pattern = make_pattern(static_cast<std::size_t>(n * n), entries);
    const std::vector<Index> order = locality_order(pattern.row_begin, pattern.column);

    std::vector<Index> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (Index i = 0; i < n * n; ++i) {
        EXPECT_EQ(sorted[static_cast<std::size_t>(i)], i);
    }
    for (const BlockEntry& entry : entries) { // a grid's band need not pass its two shortest rows
        EXPECT_LE(std::abs(order[static_cast<std::size_t>(entry.row)] -
                           order[static_cast<std::size_t>(entry.column)]),
                  2 * n);
    }
}

namespace {

Precondition apply_of(IncompleteCholesky& preconditioner) {
    return [&](std::span<const Vec3> r, std::span<Vec3> z) { preconditioner.apply(r, z); };
}

} // namespace

TEST(ConjugateGradient, SolvesToTheResidualAskedFor) {
    const BlockMatrix matrix = random_matrix(3000, 4); // several domains of the preconditioner
    const std::vector<Vec3> expected = random_vector(3000, 5);
    std::vector<Vec3> b(3000);
    multiply(matrix, expected, b);
    IncompleteCholesky preconditioner;
    preconditioner.factor(matrix);
    std::vector<Vec3> x(3000, Vec3::Zero());
    ConjugateGradient cg;

    const CgReport report = cg.solve(matrix, apply_of(preconditioner), b, x, {.tolerance = 1e-12});

    EXPECT_TRUE(report.converged);
    EXPECT_LT((flatten(x) - flatten(expected)).norm(), 1e-10);
}

TEST(ConjugateGradient, SaysWhenItDidNotConverge) {
    BlockMatrix matrix = random_matrix(50, 6);
    const std::vector<Vec3> b = random_vector(50, 7);
    IncompleteCholesky preconditioner;
    preconditioner.factor(matrix);
    std::vector<Vec3> x(50, Vec3::Zero());
    ConjugateGradient cg;

    const CgReport report =
        cg.solve(matrix, apply_of(preconditioner), b, x, {.tolerance = 1e-12, .max_iterations = 1});

    EXPECT_FALSE(report.converged);
    EXPECT_GT(report.residual, 1e-12);
}

TEST(IncompleteCholesky, IsExactWhereNothingFillsIn) {
    std::vector<BlockEntry> chain;
    for (Index i = 0; i + 1 < 30; ++i) {
        chain.push_back({i, i + 1});
    }
    BlockMatrix matrix = make_pattern(30, chain);
    for (std::size_t r = 0; r < 30; ++r) {
        for (Index k = matrix.row_begin[r]; k < matrix.row_begin[r + 1]; ++k) {
            const bool diagonal = k == matrix.diagonal[r];
            matrix.blocks[static_cast<std::size_t>(k)] = (diagonal ? 3.0 : -1.0) * Mat3::Identity();
        }
    }
    const std::vector<Vec3> x = random_vector(30, 8);
    std::vector<Vec3> b(30);
    multiply(matrix, x, b);
    IncompleteCholesky preconditioner;
    preconditioner.factor(matrix);
    std::vector<Vec3> z(30);

    preconditioner.apply(b, z);

    EXPECT_LT((flatten(z) - flatten(x)).norm(), 1e-5); // single precision
    EXPECT_EQ(preconditioner.shift(), 0.0);
}

} // namespace weft
