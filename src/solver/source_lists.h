#pragma once

#include <array>

#include "solver/element_rooms.h"
#include "solver/list_pool.h"

namespace weft {

/// Which elements' forces sum into which vertex, and which elements' blocks into which block of the
/// matrix. Lists are always in the order of the elements, so that they are the same for the same
/// elements, however these have come about. When elements change, the rows of their vertices are
/// listed anew and no others: a block can only change where both its vertices are touched. Of a row
/// that only constants reach, only these are summed anew.
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

    /// Forces and neighbours of all elements, made anew, but pairs have no numbers yet.
    void build(const ElementRooms& rooms, std::span<const ElementSet> sets);

    /// Numbers the pairs row after row and lists what sums into them.
    /// @param sites of the rows
    void build_pairs(const ElementRooms& rooms,
                     std::span<const ElementSet> sets,
                     std::span<const Index> sites);

    /// Changes elements for those that the sets have now in rooms that have not moved since.
    /// @param changed slots of each set, new ones included, without those that are gone
    void change(const ElementRooms& rooms,
                std::span<const ElementSet> sets,
                std::span<const std::vector<Index>> changed);

    /// Rows whose blocks were listed anew since all was built.
    std::size_t changed_rows() const { return changed_rows_; }

    /// Neighbours of a vertex by ascending site, itself among them.
    std::span<const Neighbour> neighbours(std::size_t site) const { return neighbours_[site]; }

    /// Places in the array of element forces.
    std::span<const std::uint32_t> forces(std::size_t site) const { return forces_[site]; }

    std::size_t pair_count() const { return blocks_.size(); } ///< numbers given, used or not

    /// How a block sums into a pair, beside 4 * its place in the array of element blocks.
    enum Manner : std::uint32_t { k_as_it_is = 0, k_transposed = 1, k_negative = 2 };
    static constexpr std::uint32_t k_manners = 4;

    /// k_manners * place + manner.
    std::span<const std::uint32_t> blocks(std::size_t pair) const { return blocks_[pair]; }

    /// Sum of the constant blocks, N/m.
    double constant(std::size_t pair) const { return constant_[pair]; }

private:
    /// What is to be done anew of a row; flags.
    enum Need : std::uint8_t { k_neighbours = 1, k_blocks = 2, k_constants = 4 };

    /// A neighbour of the row that is being listed, and what sums into the pair with it.
    struct RowEntry {
        Index site;
        Index pair = k_no_index;  ///< none yet, or none any more
        std::uint32_t is_met = 0; ///< elements join it
        std::uint32_t blocks = 0; ///< of what was gathered, when it is at no lower site
        std::uint32_t end = 0;    ///< of its blocks in dealt_
        double constant = 0.0;
    };
    /// A block that sums into the pair with a neighbour of the row.
    struct Gathered {
        std::uint32_t place, source; ///< source: as blocks()
    };
    /// Of a site: the last row in which it was found, and where.
    struct Mark {
        std::uint32_t row, place;
    };

    void number_sources(const ElementRooms& rooms);
    void list_nodes(const ElementRooms& rooms, std::span<const ElementSet> sets);
    void list_forces(const ElementRooms& rooms);
    void list_neighbours(const ElementRooms& rooms);
    template <typename F>
    void for_each_element(const ElementRooms& rooms,
                          std::size_t site,
                          std::uint8_t needs,
                          const F& f) const;

    void begin_row(std::size_t site);
    std::uint32_t add_neighbour(Index site);

    /// Where in the present row its neighbour at a site is, a new one when it has not been met
    /// before. In line: it is asked of each node of each element at a site.
    std::uint32_t place_of(Index site) {
        const Mark& mark = mark_[static_cast<std::size_t>(site)];
        return mark.row == last_mark_ ? mark.place : add_neighbour(site);
    }
    void find_neighbours(const ElementRooms& rooms, std::size_t site);
    void gather_row(const ElementRooms& rooms,
                    std::span<const ElementSet> sets,
                    std::size_t site,
                    std::uint8_t needs);
    void list_row(const ElementRooms& rooms,
                  std::span<const ElementSet> sets,
                  std::size_t site,
                  std::uint8_t needs);

    void assign_blocks(std::size_t site);
    Index site_of(const ElementRooms& rooms, Index vertex);
    void touch(Index site, std::uint8_t needs);
    void change_nodes(const ElementRooms& rooms, const ElementSet& set, std::size_t s, Index slot);
    void remove_nodes(const ElementRooms& rooms, std::size_t s, std::size_t slot);
    void touch_vertices(const ElementRooms& rooms);
    void change_neighbours(std::size_t site);
    Index join(std::size_t site_a, std::size_t site_b);
    void part(std::size_t site, const Neighbour& neighbour);
    void keep_counts(const ElementRooms& rooms);

    std::vector<std::size_t> element_counts_;         ///< by set, what the lists hold
    std::vector<std::size_t> vertex_counts_;          ///< by object
    std::size_t most_nodes_ = 0;                      ///< of an element
    std::vector<std::vector<std::uint32_t>> sources_; ///< by set: as blocks(), within the element
    std::vector<Index> nodes_;        ///< sites of each element's nodes, as element forces stand
    ListPool<std::uint32_t> forces_;  ///< by site
    ListPool<Neighbour> neighbours_;  ///< by site
    ListPool<std::uint32_t> blocks_;  ///< by pair
    std::vector<double> constant_;    ///< by pair
    std::vector<Index> free_;         ///< numbers of pairs that are gone
    std::vector<char> is_present_;    ///< by site: a vertex stands there
    std::vector<Index> touched_;      ///< sites whose rows need something
    std::vector<std::uint8_t> needs_; ///< by site
    std::size_t changed_rows_ = 0;

    // while a row is listed
    std::vector<RowEntry> row_;
    std::vector<Gathered> gathered_; ///< its first gathered_count_, in the order of the elements
    std::size_t gathered_count_ = 0;
    std::vector<std::uint32_t> dealt_; ///< their sources, neighbour by neighbour
    std::vector<Mark> mark_;           ///< by site
    std::uint32_t last_mark_ = 0;

    // while an element changes
    std::vector<Index> now_;      ///< sites of its nodes
    std::size_t last_object_ = 0; ///< of a node
};

} // namespace weft
