#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace weft {

/// Many short sorted lists in one array. A list that outgrows its place moves to the end of the
/// array and, unless told otherwise, gets room to spare, so that it seldom moves again; its old
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

    /// Lists of these lengths and no more room, side by side in their order; their items are to be
    /// set.
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

    /// Whether lists that move get room to spare.
    void keep_room_to_spare(bool keep) { is_spare_kept_ = keep; }

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

    /// Takes out one item equal to this one, which must be there.
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

} // namespace weft
