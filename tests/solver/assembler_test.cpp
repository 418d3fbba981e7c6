#include "solver/assembler.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

/// Two sets on five vertices: triangles, and edges one of which is missing a node.
const std::vector<Index> k_triangles{0, 1, 2, 2, 1, 3};
const std::vector<Index> k_edges{3, 4, k_no_index, k_no_index, 0, 4};

std::vector<Mat3> random_blocks(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<Mat3> blocks(count);
    for (Mat3& block : blocks) {
        block = Mat3::NullaryExpr([&] { return value(random); });
    }
    return blocks;
}

Mat3 block_at(const BlockMatrix& matrix, std::span<const Index> rows, Index a, Index b) {
    const Index place =
        find_block(matrix, rows[static_cast<std::size_t>(a)], rows[static_cast<std::size_t>(b)]);
    return place == k_no_index ? Mat3(Mat3::Zero())
                               : matrix.blocks[static_cast<std::size_t>(place)];
}

} // namespace

TEST(Assembler, SumsTheBlocksOfAllElementsAtTheirVertices) {
    const std::vector<VertexRange> objects{{0, 5}};
    const std::vector<ElementSet> sets{{3, k_triangles, 0}, {2, k_edges, 0}};
    const Assembler assembler(objects, sets);
    const std::vector<Mat3> blocks = random_blocks(assembler.block_count(), 1);
    const std::vector<double> diagonal{1.0, 2.0, 3.0, 4.0, 5.0};
    BlockMatrix matrix = assembler.pattern();

    assembler.assemble(blocks, 1.0, diagonal, matrix);

    ASSERT_EQ(blocks.size(), 6U + 6U + 3U + 3U + 3U);
    const auto rows = assembler.row_of_vertex();
    // blocks of a triangle: 00 01 02 11 12 22; of an edge: 00 01 11
    EXPECT_EQ(block_at(matrix, rows, 0, 1), blocks[1]);
    EXPECT_EQ(block_at(matrix, rows, 1, 0), blocks[1].transpose());
    EXPECT_EQ(block_at(matrix, rows, 1, 2), blocks[4] + blocks[7].transpose());
    EXPECT_EQ(block_at(matrix, rows, 3, 4), blocks[13]);
    EXPECT_EQ(block_at(matrix, rows, 0, 4), blocks[19]);
    EXPECT_EQ(block_at(matrix, rows, 4, 4), Mat3(blocks[14] + blocks[20] + 5.0 * Mat3::Identity()));
    EXPECT_EQ(block_at(matrix, rows, 0, 3), Mat3(Mat3::Zero()));
}

TEST(Assembler, SumsTheOneBlockOfADifferenceWithItsSigns) {
    const std::vector<VertexRange> objects{{0, 4}};
    const std::vector<Index> ends{0, 1, 2, 1, 1, 3};
    const std::vector<ElementSet> sets{
        {.nodes_per_element = 2, .nodes = ends, .first_vertex = 0, .is_difference = true}};
    const Assembler assembler(objects, sets);
    std::vector<Mat3> blocks = random_blocks(assembler.block_count(), 2);
    for (Mat3& block : blocks) {
        block = Mat3(block + block.transpose());
    }
    const std::vector<double> nothing(4, 0.0);
    BlockMatrix matrix = assembler.pattern();

    assembler.assemble(blocks, 1.0, nothing, matrix);

    ASSERT_EQ(blocks.size(), 3U);
    const auto rows = assembler.row_of_vertex();
    EXPECT_EQ(block_at(matrix, rows, 0, 0), blocks[0]);
    EXPECT_EQ(block_at(matrix, rows, 0, 1), Mat3(-blocks[0]));
    EXPECT_EQ(block_at(matrix, rows, 1, 2), Mat3(-blocks[1]));
    EXPECT_EQ(block_at(matrix, rows, 1, 1), Mat3(blocks[0] + blocks[1] + blocks[2]));
    EXPECT_EQ(block_at(matrix, rows, 0, 3), Mat3(Mat3::Zero()));
}

TEST(Assembler, WhatIsGoneLeavesNothingBehind) {
    const std::vector<VertexRange> objects{{0, 5}};
    std::vector<ElementSet> sets{{3, k_triangles, 0}, {2, k_edges, 0}};
    Assembler assembler(objects, sets);
    const std::vector<Index> fewer{0, 1};
    sets[1].nodes = fewer; // edges (3, 4) and (0, 4) are gone: nothing is at vertex 4

    assembler.remesh(objects, sets, std::vector<std::vector<Index>>{{}, {0}});

    const Assembler fresh(objects, sets);
    EXPECT_EQ(assembler.pattern().column, fresh.pattern().column);
    EXPECT_EQ(assembler.pattern().row_begin, fresh.pattern().row_begin);
    const std::size_t row = static_cast<std::size_t>(assembler.row_of_vertex()[4]);
    EXPECT_EQ(assembler.pattern().row_begin[row + 1] - assembler.pattern().row_begin[row], 1);
}

TEST(Assembler, OtherConstantsBetweenTheSameNodesAreTakenUp) {
    const std::vector<VertexRange> objects{{0, 5}};
    std::vector<double> constants{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0};
    const std::vector<ElementSet> sets{{3, k_triangles, 0, true, constants}};
    Assembler assembler(objects, sets);
    constants[7] = 80.0; // of vertices 2 and 1

    assembler.remesh(objects, sets, std::vector<std::vector<Index>>{{1}});

    BlockMatrix matrix = assembler.pattern();
    const std::vector<double> nothing(5, 0.0);
    assembler.assemble({}, 0.5, nothing, matrix);
    EXPECT_EQ(block_at(matrix, assembler.row_of_vertex(), 1, 2),
              Mat3(0.5 * (5.0 + 80.0) * Mat3::Identity()));
    EXPECT_EQ(block_at(matrix, assembler.row_of_vertex(), 0, 1),
              Mat3(0.5 * 2.0 * Mat3::Identity()));
}

TEST(AssemblyLayout, RangesStayWhileTheirContentFits) {
    const std::vector<Index> nodes(60, 0);
    const auto set_of = [&](std::size_t elements) {
        return ElementSet{3, std::span(nodes).first(3 * elements), 0};
    };
    AssemblyLayout layout;
    EXPECT_FALSE(layout.fit(std::vector<VertexRange>{{0, 4}, {4, 2}},
                            std::vector<ElementSet>{set_of(2), set_of(1)}));
    EXPECT_EQ(layout.slot_of(4), 4U);
    EXPECT_FALSE(layout.fit(std::vector<VertexRange>{{0, 6}, {6, 2}},
                            std::vector<ElementSet>{set_of(4), set_of(1)})); // half as much again
    EXPECT_EQ(layout.slot_of(6), 9U);
    EXPECT_EQ(layout.sets()[1].force_begin, 18U);
    EXPECT_EQ(layout.sets()[1].block_begin, 36U);

    EXPECT_TRUE(layout.fit(std::vector<VertexRange>{{0, 9}, {9, 2}},
                           std::vector<ElementSet>{set_of(6), set_of(1)}));
    EXPECT_EQ(layout.slot_of(8), 8U);
    EXPECT_EQ(layout.slot_of(9), 9U);
    EXPECT_EQ(layout.sets()[1].force_begin, 18U);
}

TEST(ListPool, HoldsWhatSortedVectorsWould) {
    std::mt19937 random(1);
    std::vector<std::vector<int>> expected(20);
    ListPool<int> pool;
    const std::vector<std::uint32_t> lengths(10, 0);
    pool.reset(lengths);
    for (int i = 0; i < 10; ++i) {
        pool.add_list();
    }
    for (int step = 0; step < 5000; ++step) {
        const std::size_t list = random() % expected.size();
        std::vector<int>& row = expected[list];
        const int dice = static_cast<int>(random() % 20);
        if (dice == 0) {
            row.assign(random() % 30, 7);
            pool.assign(list, row);
        } else if (dice < 11 || row.empty()) {
            const int item = static_cast<int>(random() % 50);
            row.insert(std::upper_bound(row.begin(), row.end(), item), item);
            pool.insert(list, item);
        } else {
            const int item = row[random() % row.size()];
            row.erase(std::lower_bound(row.begin(), row.end(), item));
            pool.erase(list, item);
        }
        pool.keep_spare(step % 100 < 50);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            ASSERT_TRUE(std::ranges::equal(pool[i], expected[i]));
        }
    }
}

} // namespace weft
