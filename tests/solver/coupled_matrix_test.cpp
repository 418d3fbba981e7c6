#include <gtest/gtest.h>

#include <random>

#include "solver/coupled_matrix.h"

namespace weft {

namespace {

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

Eigen::MatrixXd dense(const BlockMatrix& matrix) {
    const auto size = static_cast<Eigen::Index>(3 * matrix.rows());
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t r = 0; r < matrix.rows(); ++r) {
        for (Index k = matrix.row_begin[r]; k < matrix.row_begin[r + 1]; ++k) {
            const Index c = matrix.column[static_cast<std::size_t>(k)];
            result.block<3, 3>(3 * static_cast<Eigen::Index>(r), 3 * c) +=
                matrix.blocks[static_cast<std::size_t>(k)];
        }
    }
    return result;
}

} // namespace

TEST(CoupledMatrix, HasTheBlocksOfItsBaseAndZerosWhereContactsJoin) {
    const BlockMatrix base = ring();
    CoupledMatrix coupled;
    const std::vector<BlockEntry> joined{{7, 2}, {0, 11}, {2, 7}, {0, 5}, {11, 3}};

    EXPECT_TRUE(coupled.couple(base, joined));
    coupled.load(base);

    EXPECT_EQ(dense(coupled.matrix()), dense(base));
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
    EXPECT_EQ(dense(coupled.matrix()), dense(base));
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

    EXPECT_EQ(dense(coupled.matrix()), dense(base));
}

} // namespace weft
