#include "solver/block_matrix.h"
#include "solver/conjugate_gradient.h"
#include "solver/preconditioner.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

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

constexpr std::size_t k_rows = 12;

/// A ring: each row is joined to the next one, with random blocks.
BlockMatrix ring() {
    std::vector<BlockEntry> entries;
    for (std::size_t r = 0; r < k_rows; ++r) {
        entries.push_back({static_cast<Index>(r), static_cast<Index>((r + 1) % k_rows)});
    }
    BlockMatrix matrix = make_pattern(k_rows, entries);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (Mat3& block : matrix.blocks) {
        block = Mat3::NullaryExpr([&] { return value(random); });
    }
    return matrix;
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

TEST(CoupledMatrix, HasTheBlocksOfItsBaseAndZerosWhereContactsJoin) {
    const BlockMatrix base = ring();
    CoupledMatrix coupled;
    const std::vector<BlockEntry> joined{{7, 2}, {0, 11}, {2, 7}, {0, 5}, {11, 3}};

    EXPECT_TRUE(coupled.couple(base, joined));
    coupled.load(base);

    EXPECT_EQ(to_dense(coupled.matrix()), to_dense(base));
    for (const BlockEntry& entry : joined) {
        EXPECT_NE(find_block(coupled.matrix(), entry.row, entry.column), k_no_index);
        EXPECT_NE(find_block(coupled.matrix(), entry.column, entry.row), k_no_index);
    }
    for (std::size_t r = 0; r < k_rows; ++r) {
        EXPECT_EQ(coupled.matrix().diagonal[r],
                  find_block(coupled.matrix(), static_cast<Index>(r), static_cast<Index>(r)));
    }
}

TEST(CoupledMatrix, ChangesItsPatternOnlyWhenOtherBlocksAreJoined) {
    const BlockMatrix base = ring();
    CoupledMatrix coupled;
    const std::vector<BlockEntry> joined{{7, 2}, {0, 5}};
    const std::vector<BlockEntry> again{{5, 0}, {3, 4}, {2, 7}, {7, 2}}; // 3, 4: in the base
    const std::vector<BlockEntry> fewer{{0, 5}};

    EXPECT_TRUE(coupled.couple(base, joined));
    EXPECT_FALSE(coupled.couple(base, again));
    EXPECT_TRUE(coupled.couple(base, fewer));

    coupled.load(base);
    EXPECT_EQ(to_dense(coupled.matrix()), to_dense(base));
    EXPECT_EQ(find_block(coupled.matrix(), 7, 2), k_no_index);
}

TEST(CoupledMatrix, ForgetsWhatWasAddedToItsBlocks) {
    const BlockMatrix base = ring();
    CoupledMatrix coupled;
    const std::vector<BlockEntry> joined{{7, 2}};
    coupled.couple(base, joined);
    coupled.load(base);
    for (Mat3& block : coupled.matrix().blocks) {
        block.setConstant(7.0);
    }

    coupled.load(base);

    EXPECT_EQ(to_dense(coupled.matrix()), to_dense(base));
}

} // namespace weft
