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
    bool is_difference = false; ///< of two nodes and one symmetric block, which is that of each
                                ///< with itself, and its negative that between them

    std::size_t count() const { return nodes.size() / static_cast<std::size_t>(nodes_per_element); }
    std::size_t blocks_per_element() const {
        return is_difference
                   ? 1
                   : static_cast<std::size_t>(nodes_per_element * (nodes_per_element + 1) / 2);
    }
};

/// Where the vertices of one object that are solved for stand in World.
struct VertexRange {
    Index first, count;
};

/// Where vertices and elements stand in the arrays of an assembly. Every object and every set has
/// a room there that is kept while it grows and shrinks within it, so that what stands in other
/// rooms need not be touched. A vertex's place is called its site; sites are in the order of
/// vertices, but may have gaps.
class ElementRooms {
public:
    struct Set {
        std::size_t nodes_per_element, blocks_per_element;
        std::size_t count, capacity; ///< elements
        std::size_t force_begin;     ///< in the array of element forces, one a node
        std::size_t block_begin;     ///< in that of element blocks; constant sets have their own
        bool is_constant, is_difference;
        std::uint64_t reciprocal; ///< of nodes_per_element, in 2^-33

        /// Element of a node. Multiplied, as there are tens of these for each row of a matrix.
        /// @param node counted from the set's first, below 2^30; the division is exact so far, for
        ///             up to 8 nodes an element
        std::uint32_t element_of(std::uint32_t node) const {
            return static_cast<std::uint32_t>((node * reciprocal) >> 33);
        }
    };
    struct Object {
        std::size_t first, count; ///< vertices of World
        std::size_t capacity;
        std::size_t begin; ///< site of the first
    };

    /// Takes up what sets and objects are now; false when it had to move rooms, and all places are
    /// others than before. Rooms are as large as their first content, then with half as much again.
    /// The number of sets and objects must always be the same; objects stand one after the other,
    /// perhaps with vertices between them that are not solved for.
    bool fit(std::span<const VertexRange> objects, std::span<const ElementSet> sets);

    std::span<const Set> sets() const { return sets_; }
    std::span<const Object> objects() const { return objects_; }
    std::size_t vertex_count() const;                      ///< up to the last object's end
    std::size_t site_count() const { return site_count_; } ///< room for vertices
    std::size_t force_count() const { return force_count_; }
    std::size_t block_count() const { return block_count_; } ///< of the sets that are not constant
    std::size_t constant_count() const { return constant_count_; }

    std::size_t site_of(Index vertex) const;

    /// Number of the object that a vertex is of.
    std::size_t object_of(Index vertex) const;

    /// Site of entry i of set.nodes, or k_no_index.
    Index site_of_node(const ElementSet& set, std::size_t i) const {
        return set.nodes[i] == k_no_index
                   ? k_no_index
                   : static_cast<Index>(site_of(set.nodes[i] + set.first_vertex));
    }

private:
    void lay_out();

    std::vector<Set> sets_;
    std::vector<Object> objects_;
    std::size_t site_count_ = 0, force_count_ = 0, block_count_ = 0, constant_count_ = 0;
};

} // namespace weft
