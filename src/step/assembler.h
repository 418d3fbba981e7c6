#pragma once

#include "step/block_matrix.h"

namespace weft {

/// One family of elements, as the assembler sees it: which vertices each joins.
struct ElementSet {
    int nodes_per_element;
    std::span<const Index>
        nodes;          ///< #elements * nodes_per_element, local; k_no_index: no such node
    Index first_vertex; ///< added to each node

    std::size_t count() const { return nodes.size() / static_cast<std::size_t>(nodes_per_element); }
    std::size_t blocks_per_element() const {
        return static_cast<std::size_t>(nodes_per_element * (nodes_per_element + 1) / 2);
    }
};

/// Sums what elements wrote into vertices and matrix blocks, always in the order of the elements,
/// so that the result is the same bits for any thread count. Blocks of an element are its upper
/// triangle row by row; forces one a node. The arrays of all sets stand one after the other, those
/// of the constant sets (whose blocks are scalars times the identity and never change) last.
class Assembler {
public:
    /// @param constant_blocks  scalars of the constant sets, N/m
    Assembler(std::size_t vertex_count,
              std::span<const ElementSet> sets,
              std::span<const ElementSet> constant_sets,
              std::span<const double> constant_blocks);

    std::size_t block_count() const { return block_count_; } ///< of the sets that are not constant
    std::size_t force_count() const { return force_count_; }

    /// The pattern, rows ordered for locality; row_of_vertex maps to it.
    const BlockMatrix& pattern() const { return pattern_; }
    std::span<const Index> row_of_vertex() const { return row_of_vertex_; }

    /// matrix.blocks = sum of element blocks + constant_scale * sum of constant blocks
    ///                 + diagonal[v] * I for vertex v.
    void assemble(std::span<const Mat3> element_blocks,
                  double constant_scale,
                  std::span<const double> diagonal,
                  BlockMatrix& matrix) const;

    /// forces[v] = sum of the element forces at vertex v.
    void gather_forces(std::span<const Vec3> element_forces, std::span<Vec3> forces) const;

private:
    struct Upper {
        Index place, mirror; ///< in matrix.blocks; equal on the diagonal
    };

    void build_pattern(std::size_t vertex_count, std::span<const ElementSet> sets);
    void build_block_sources(std::span<const ElementSet> sets);
    void sum_constant_blocks(std::span<const ElementSet> sets, std::span<const double> blocks);
    void build_force_sources(std::size_t vertex_count, std::span<const ElementSet> sets);
    Index upper_of(Index vertex_a, Index vertex_b, bool& transposed) const;

    std::size_t block_count_ = 0;
    std::size_t force_count_ = 0;
    BlockMatrix pattern_;
    std::vector<Index> row_of_vertex_;
    std::vector<Index> vertex_of_row_;
    std::vector<Upper> uppers_;
    std::vector<Index> upper_of_place_;     ///< of each block of the pattern; k_no_index below
    std::vector<double> constant_;          ///< #uppers, sum of the constant blocks, N/m
    std::vector<std::size_t> source_begin_; ///< #uppers + 1
    std::vector<std::uint32_t> sources_;    ///< 2 * element block + (1: transposed)
    std::vector<std::size_t> force_begin_;  ///< #vertices + 1
    std::vector<std::uint32_t> force_sources_;
};

} // namespace weft
