#pragma once

#include "solver/assembly_layout.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace weft {

/// Many short sorted lists in one array. A list that outgrows its capacity moves to the end of the
/// array and, unless told otherwise, gets spare capacity, so that it seldom moves again; its old
/// place is lost.
template <typename T> class ListPool {
public:
    std::size_t size() const { return lists_.size(); }

    std::span<const T> operator[](std::size_t list) const {
        return {items_.data() + lists_[list].begin, lists_[list].size};
    }
    std::span<T> operator[](std::size_t list) {
        return {items_.data() + lists_[list].begin, lists_[list].size};
    }

    /// Lists of these lengths without spare capacity, side by side in their order; the caller sets
    /// their items.
    void reset(std::span<const std::uint32_t> lengths) {
        lists_.clear();
        std::size_t begin = 0;
        for (const std::uint32_t length : lengths) {
            lists_.push_back({static_cast<std::uint32_t>(begin), length, length});
            begin += length;
        }
        assert(begin < std::numeric_limits<std::uint32_t>::max());
        items_.clear();
        items_.resize(begin);
    }

    /// Whether lists that move get spare capacity.
    void keep_spare(bool keep) { is_spare_kept_ = keep; }

    /// Appends an empty list.
    void add_list() { lists_.push_back({0, 0, 0}); }

    void insert(std::size_t list, const T& item) {
        if (lists_[list].size == lists_[list].capacity) {
            move_to_end(list, lists_[list].size + 1);
        }
        T* const begin = items_.data() + lists_[list].begin;
        T* const end = begin + lists_[list].size++;
        T* const place = std::upper_bound(begin, end, item);
        std::copy_backward(place, end, end + 1);
        *place = item;
    }

    /// Sets a list's items, sorted.
    void assign(std::size_t list, std::span<const T> items) {
        if (items.size() > lists_[list].capacity) {
            lists_[list].size = 0; // nothing to take along
            move_to_end(list, static_cast<std::uint32_t>(items.size()));
        }
        lists_[list].size = static_cast<std::uint32_t>(items.size());
        std::copy(items.begin(), items.end(), items_.begin() + lists_[list].begin);
    }

    /// Removes one item equal to this one, which must be there.
    void erase(std::size_t list, const T& item) {
        T* const begin = items_.data() + lists_[list].begin;
        T* const end = begin + lists_[list].size--;
        T* const place = std::lower_bound(begin, end, item);
        assert(place != end && !(item < *place));
        std::copy(place + 1, end, place);
    }

private:
    struct List {
        std::uint32_t begin, size, capacity;
    };

    void move_to_end(std::size_t list, std::uint32_t least) {
        List& moved = lists_[list];
        const std::size_t begin = items_.size();
        const std::uint32_t capacity = is_spare_kept_ ? least + std::max(3U, least / 2) : least;
        assert(begin + capacity < std::numeric_limits<std::uint32_t>::max());
        items_.resize(begin + capacity);
        std::copy_n(items_.begin() + moved.begin, moved.size,
                    items_.begin() + static_cast<std::ptrdiff_t>(begin));
        moved.begin = static_cast<std::uint32_t>(begin);
        moved.capacity = capacity;
    }

    bool is_spare_kept_ = true;
    std::vector<List> lists_;
    std::vector<T> items_;
};

/// Says which element forces sum into each vertex, and which element blocks into each block of the
/// matrix. Lists are in the order of the elements, so that equal elements give equal lists,
/// whatever changes have led to them. When elements change, only the rows of their vertices are
/// rebuilt: a block can only change where both its vertices are dirty. Where only constant blocks
/// changed, only their sums are.
///
/// A pair is two vertices, or one and itself, that an element joins: two blocks of the matrix that
/// are each other's transpose, or one on the diagonal. Each pair has a number, which is used again
/// when the pair is gone. Its list holds the blocks whose row is the lower of its two slots.
class ScatterMap {
public:
    struct Neighbour {
        Index slot, pair;
        bool operator<(const Neighbour& other) const { return slot < other.slot; }
    };

    /// Lists forces and neighbours of all elements from nothing; pairs have no numbers yet.
    void build(const AssemblyLayout& layout, std::span<const ElementSet> sets);

    /// Numbers the pairs row after row and lists the blocks that sum into them.
    /// @param slots  by row
    void build_pairs(const AssemblyLayout& layout,
                     std::span<const ElementSet> sets,
                     std::span<const Index> slots);

    /// Follows elements that changed in a layout whose ranges have not moved since.
    /// @param changed  by set: its elements that changed, new ones included, removed ones not
    void remesh(const AssemblyLayout& layout,
                std::span<const ElementSet> sets,
                std::span<const std::vector<Index>> changed);

    /// Rows whose block lists were rebuilt since build().
    std::size_t changed_rows() const { return changed_rows_; }

    /// Neighbours of a vertex by ascending slot, itself among them.
    std::span<const Neighbour> neighbours(std::size_t slot) const { return neighbours_[slot]; }

    /// Places in the array of element forces that sum into a vertex.
    std::span<const std::uint32_t> forces(std::size_t slot) const { return forces_[slot]; }

    std::size_t pair_count() const { return blocks_.size(); } ///< numbers given, used or not

    /// Sources (see BlockPlacement) that sum into a pair.
    std::span<const std::uint32_t> blocks(std::size_t pair) const { return blocks_[pair]; }

    /// Sum of the constant blocks, N/m.
    double constant(std::size_t pair) const { return constants_[pair]; }

private:
    /// Parts of a row that must be rebuilt; flags.
    enum Dirty : std::uint8_t { k_neighbours = 1, k_blocks = 2, k_constants = 4 };

    /// A neighbour of the current row, and what sums into the pair with it.
    struct RowEntry {
        Index slot;
        Index pair = k_no_index;     ///< none yet, or none any more
        std::uint32_t is_joined = 0; ///< by an element
        std::uint32_t blocks = 0;    ///< number of gathered blocks; 0 for a lower slot
        std::uint32_t end = 0;       ///< end of its blocks in sorted_sources_
        double constant = 0.0;
    };
    /// A block that sums into the pair with a neighbour of the current row.
    struct Gathered {
        std::uint32_t entry, source;
    };
    /// The last row in which a slot was found, and its entry there.
    struct Mark {
        std::uint32_t row, entry;
    };

    void list_nodes(const AssemblyLayout& layout, std::span<const ElementSet> sets);
    void list_forces(const AssemblyLayout& layout);
    void list_neighbours(const AssemblyLayout& layout);
    template <typename F>
    void for_each_element(const AssemblyLayout& layout,
                          std::size_t slot,
                          std::uint8_t dirty,
                          const F& f) const;

    void begin_row(std::size_t slot);
    std::uint32_t add_neighbour(Index slot);

    /// Entry of a slot in the current row; a new one at the first call for that slot. Inline, as it
    /// is called for each node of each element at a slot.
    std::uint32_t entry_of(Index slot) {
        const Mark& mark = mark_[static_cast<std::size_t>(slot)];
        return mark.row == last_mark_ ? mark.entry : add_neighbour(slot);
    }
    void find_neighbours(const AssemblyLayout& layout, std::size_t slot);
    void gather_row(const AssemblyLayout& layout,
                    std::span<const ElementSet> sets,
                    std::size_t slot,
                    std::uint8_t dirty);
    void list_row(const AssemblyLayout& layout,
                  std::span<const ElementSet> sets,
                  std::size_t slot,
                  std::uint8_t dirty);

    void assign_blocks(std::size_t slot);
    Index slot_of(const AssemblyLayout& layout, Index vertex);
    void mark_dirty(Index slot, std::uint8_t dirty);
    void replace_nodes(const AssemblyLayout& layout,
                       const ElementSet& set,
                       std::size_t s,
                       Index element);
    void remove_nodes(const AssemblyLayout& layout, std::size_t s, std::size_t element);
    void mark_vertices_dirty(const AssemblyLayout& layout);
    void update_pairs(std::size_t slot);
    Index add_pair(std::size_t slot_a, std::size_t slot_b);
    void remove_pair(std::size_t slot, const Neighbour& neighbour);
    void keep_counts(const AssemblyLayout& layout);

    std::vector<std::size_t> element_counts_;                 ///< by set, what the lists hold
    std::vector<std::size_t> vertex_counts_;                  ///< by object
    std::size_t most_nodes_ = 0;                              ///< most nodes of any element
    std::vector<std::vector<std::uint32_t>> element_sources_; ///< by set, see block_sources()
    std::vector<Index> nodes_;        ///< slot of each element's nodes, as element forces stand
    ListPool<std::uint32_t> forces_;  ///< by slot
    ListPool<Neighbour> neighbours_;  ///< by slot
    ListPool<std::uint32_t> blocks_;  ///< by pair
    std::vector<double> constants_;   ///< by pair
    std::vector<Index> free_;         ///< numbers of pairs that are gone
    std::vector<char> is_present_;    ///< by slot: a vertex stands there
    std::vector<Index> dirty_slots_;  ///< slots of rows with a flag
    std::vector<std::uint8_t> dirty_; ///< flags, by slot
    std::size_t changed_rows_ = 0;

    // while a row is listed
    std::vector<RowEntry> row_;
    std::vector<Gathered> gathered_; ///< its first gathered_count_, in the order of the elements
    std::size_t gathered_count_ = 0;
    std::vector<std::uint32_t> sorted_sources_; ///< sources of gathered_, neighbour by neighbour
    std::vector<Mark> mark_;                    ///< by slot
    std::uint32_t last_mark_ = 0;

    // while an element changes
    std::vector<Index> now_;      ///< slots of its nodes
    std::size_t last_object_ = 0; ///< that slot_of() found
};

} // namespace weft
