#pragma once

#include "base/eigen.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// One family of elements, as the assembler sees it: which vertices each joins.
struct ElementSet {
    int nodes_per_element;
    std::span<const Index>
        nodes;                ///< #elements * nodes_per_element, local; k_no_index: no such node
    Index first_vertex;       ///< added to each node
    bool is_constant = false; ///< blocks are scalars times the identity, these:
    std::span<const double> constants{}; ///< upper triangle of each element, N/m
    bool is_difference = false; ///< two nodes and one symmetric block: it stands at each node with
                                ///< itself, and its negative between the two

    std::size_t count() const { return nodes.size() / static_cast<std::size_t>(nodes_per_element); }
    std::size_t blocks_per_element() const {
        return is_difference
                   ? 1
                   : static_cast<std::size_t>(nodes_per_element * (nodes_per_element + 1) / 2);
    }
};

/// The range of World vertices of one object that are solved for.
struct VertexRange {
    Index first, count;
};

/// How a block of an element adds to a block of the matrix. A source is a number that holds both:
/// k_placements * (place of the element block) + placement.
enum BlockPlacement : std::uint32_t { k_as_is = 0, k_transposed = 1, k_negative = 2 };
inline constexpr std::uint32_t k_placements = 4;

/// Layout of the arrays of an assembly. Every object and every set has a range there with spare
/// capacity, which stays where it is while the content fits, so that a mesh that changes leaves the
/// ranges of others untouched. The place of a vertex is its slot; slots ascend with vertices, but
/// leave gaps.
class AssemblyLayout {
public:
    struct Set {
        std::size_t nodes_per_element, blocks_per_element;
        std::size_t count, capacity; ///< elements
        std::size_t force_begin;     ///< in the array of element forces, one a node
        std::size_t block_begin;     ///< in that of element blocks; constant sets have their own
        bool is_constant, is_difference;
        std::uint64_t reciprocal; ///< 1 / nodes_per_element, in units of 2^-33

        /// Element of a node. Multiplied, as there are tens of these for each row of a matrix.
        /// @param node counted from the set's first, below 2^30; the division is exact so far, for
        ///             up to 8 nodes an element
        std::uint32_t element_of(std::uint32_t node) const {
            return static_cast<std::uint32_t>((node * reciprocal) >> 33);
        }

        /// Sources of the pairs of nodes (k, j) of one element, n k + j for n nodes; the place
        /// counts from the element's first block.
        std::vector<std::uint32_t> block_sources() const;
    };
    struct Object {
        std::size_t first, count; ///< vertices of World
        std::size_t capacity;
        std::size_t begin; ///< slot of the first
    };

    /// Fits the ranges to the sets and objects. Returns false when ranges had to move, so that all
    /// places are others than before. A range is as large as its first content, and half as much
    /// again when it must grow. The number of sets and objects must never change; objects stand one
    /// after the other, perhaps with vertices between them that are not solved for.
    bool fit(std::span<const VertexRange> objects, std::span<const ElementSet> sets);

    std::span<const Set> sets() const { return sets_; }
    std::span<const Object> objects() const { return objects_; }
    std::size_t vertex_count() const;                      ///< up to the last object's end
    std::size_t slot_count() const { return slot_count_; } ///< with the gaps
    std::size_t force_count() const { return force_count_; }
    std::size_t block_count() const { return block_count_; } ///< without the constant sets
    std::size_t constant_count() const { return constant_count_; }

    std::size_t slot_of(Index vertex) const;

    /// Number of the object that has the vertex.
    std::size_t object_of(Index vertex) const;

    /// Slot of entry i of set.nodes, or k_no_index.
    Index slot_of_node(const ElementSet& set, std::size_t i) const {
        return set.nodes[i] == k_no_index
                   ? k_no_index
                   : static_cast<Index>(slot_of(set.nodes[i] + set.first_vertex));
    }

private:
    void lay_out();

    std::vector<Set> sets_;
    std::vector<Object> objects_;
    std::size_t slot_count_ = 0, force_count_ = 0, block_count_ = 0, constant_count_ = 0;
};

} // namespace weft
