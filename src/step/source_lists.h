#pragma once

#include "step/element_rooms.h"
#include "step/list_pool.h"

#include <array>

namespace weft {

/// Which elements' forces sum into which vertex, and which elements' blocks into which block of the
/// matrix. It is changed element by element; lists are always in the order of the elements, so that
/// they are the same for the same elements, however these have come about.
///
/// A pair is two vertices, or one and itself, that an element joins: two blocks of the matrix that
/// are each other's transpose, or one on the diagonal. Each has a number, which is used again when
/// the pair is gone. What sums into a pair is the block whose row is its lower site.
class SourceLists {
public:
    struct Neighbour {
        Index site, pair;
        bool operator<(const Neighbour& other) const { return site < other.site; }
    };

    /// Lists of all elements, made anew, but pairs have no numbers yet.
    void build(const ElementRooms& rooms, std::span<const ElementSet> sets);

    /// Numbers the pairs as they come along the rows of an upper triangle, row after row, and lists
    /// what sums into them.
    /// @param sites of the rows
    /// @param row_of_site its inverse
    void number_pairs(const ElementRooms& rooms,
                      std::span<const ElementSet> sets,
                      std::span<const Index> sites,
                      std::span<const Index> row_of_site);

    /// Changes elements for those that the sets have now in rooms that have not moved since.
    /// @param changed slots of each set, new ones included, without those that are gone
    void change(const ElementRooms& rooms,
                std::span<const ElementSet> sets,
                std::span<const std::vector<Index>> changed);

    /// Elements that other nodes were given, or that came or went, since all was made anew.
    std::size_t altered_count() const { return altered_count_; }

    /// Neighbours of a vertex by ascending site, itself among them.
    std::span<const Neighbour> neighbours(std::size_t site) const { return neighbours_[site]; }

    /// Places in the array of element forces.
    std::span<const std::uint32_t> forces(std::size_t site) const { return forces_[site]; }

    std::size_t pair_count() const { return blocks_.size(); } ///< numbers given, used or not

    /// 2 * place in the array of element blocks + (1: transposed).
    std::span<const std::uint32_t> blocks(std::size_t pair) const { return blocks_[pair]; }

    /// Sum of the constant blocks, N/m.
    double constant(std::size_t pair) const { return constant_[pair]; }

private:
    /// An element some of whose nodes are others than before.
    struct Altered {
        Index slot;
        unsigned moved; ///< bit k: node k
    };

    void find_nodes(const ElementRooms& rooms, std::span<const ElementSet> sets);
    void list_forces(const ElementRooms& rooms);
    void list_neighbours(const ElementRooms& rooms);
    void list_blocks(const ElementRooms& rooms, bool constant, ListPool<std::uint32_t>& lists);
    void sum_constants(const ElementRooms& rooms, std::span<const ElementSet> sets, Index pair);
    void take_out(const ElementRooms::Set& set, std::size_t slot, unsigned moved);
    void put_in(const ElementRooms::Set& set, std::size_t slot, unsigned moved);
    Index pair_of(std::size_t site_a, std::size_t site_b) const;
    Index join(std::size_t site_a, std::size_t site_b);
    void part(Index pair);
    void touch(Index pair);
    void take_out_altered(const ElementRooms& rooms,
                          std::span<const ElementSet> sets,
                          std::span<const std::vector<Index>> changed);
    void add_and_remove_vertices(const ElementRooms& rooms);
    void settle_touched(const ElementRooms& rooms, std::span<const ElementSet> sets);
    std::span<Index> nodes_of(const ElementRooms::Set& set, std::size_t slot) {
        return {&nodes_[set.force_begin + slot * set.nodes_per_element], set.nodes_per_element};
    }
    void keep_counts(const ElementRooms& rooms);

    std::size_t altered_count_ = 0;
    std::vector<std::size_t> element_counts_; ///< by set, what the lists hold
    std::vector<std::size_t> vertex_counts_;  ///< by object
    std::vector<Index> nodes_;          ///< sites of each element's nodes, as element forces stand
    ListPool<std::uint32_t> forces_;    ///< by site
    ListPool<Neighbour> neighbours_;    ///< by site
    ListPool<std::uint32_t> blocks_;    ///< by pair
    ListPool<std::uint32_t> constants_; ///< by pair, as blocks, in the array of constant blocks
    std::vector<double> constant_;      ///< by pair
    std::vector<std::array<Index, 2>> sites_;   ///< of each pair, the lower one first
    std::vector<Index> free_;                   ///< numbers of pairs that are gone
    std::vector<Index> touched_;                ///< pairs whose lists a change altered
    std::vector<char> is_touched_;              ///< by pair
    std::vector<std::vector<Altered>> altered_; ///< by set, during a change
};

} // namespace weft
