#include <algorithm>

#include "solver/source_lists.h"

/// Source lists when elements change.
namespace weft {

void SourceLists::change(const ElementRooms& rooms,
                         std::span<const ElementSet> sets,
                         std::span<const std::vector<Index>> changed) {
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (std::size_t slot = rooms.sets()[s].count; slot < element_counts_[s]; ++slot) {
            remove_nodes(rooms, s, slot);
        }
        for (const Index slot : changed[s]) {
            change_nodes(rooms, sets[s], s, slot);
        }
    }
    touch_vertices(rooms);
    std::sort(touched_.begin(), touched_.end());
    for (const Index site : touched_) {
        list_row(rooms, sets, at(site), needs_[at(site)]);
        changed_rows_ += (needs_[at(site)] & k_blocks) != 0 ? 1 : 0;
        needs_[at(site)] = 0;
    }
    touched_.clear();
    keep_counts(rooms);
}

void SourceLists::touch(Index site, std::uint8_t needs) {
    if (site == k_no_index) {
        return;
    }
    if (needs_[at(site)] == 0) {
        touched_.push_back(site);
    }
    needs_[at(site)] |= needs;
}

/// Nodes of an element are mostly of one object, and of the last one's.
Index SourceLists::site_of(const ElementRooms& rooms, Index vertex) {
    const auto v = static_cast<std::size_t>(vertex);
    const ElementRooms::Object& last = rooms.objects()[last_object_];
    if (v < last.first || v >= last.first + last.count) {
        last_object_ = rooms.object_of(vertex);
    }
    const ElementRooms::Object& object = rooms.objects()[last_object_];
    return static_cast<Index>(object.begin + v - object.first);
}

/// Gives an element the nodes that it has now. One that joins the same nodes as before only
/// matters when its blocks are constant.
void SourceLists::change_nodes(const ElementRooms& rooms,
                               const ElementSet& set,
                               std::size_t s,
                               Index slot) {
    const std::size_t n = rooms.sets()[s].nodes_per_element;
    const std::size_t first = rooms.sets()[s].force_begin + at(slot) * n;
    now_.clear();
    for (const Index node : set.nodes.subspan(at(slot) * n, n)) {
        now_.push_back(node == k_no_index ? k_no_index : site_of(rooms, node + set.first_vertex));
    }
    const bool is_other =
        !std::equal(now_.begin(), now_.end(), nodes_.begin() + static_cast<std::ptrdiff_t>(first));
    if (!is_other && !set.is_constant) {
        return;
    }
    const std::uint8_t kind = set.is_constant ? k_constants : k_blocks;
    const auto needs = static_cast<std::uint8_t>(kind | (is_other ? k_neighbours : 0));
    for (std::size_t k = 0; k < n; ++k) {
        Index& node = nodes_[first + k];
        touch(node, needs);
        if (node == now_[k]) {
            continue;
        }
        touch(now_[k], needs);
        if (node != k_no_index) {
            forces_.erase(at(node), static_cast<std::uint32_t>(first + k));
        }
        if (now_[k] != k_no_index) {
            forces_.insert(at(now_[k]), static_cast<std::uint32_t>(first + k));
        }
        node = now_[k];
    }
}

void SourceLists::remove_nodes(const ElementRooms& rooms, std::size_t s, std::size_t slot) {
    const ElementRooms::Set& set = rooms.sets()[s];
    const std::size_t first = set.force_begin + slot * set.nodes_per_element;
    for (std::size_t i = first; i < first + set.nodes_per_element; ++i) {
        touch(nodes_[i], k_neighbours | (set.is_constant ? k_constants : k_blocks));
        if (nodes_[i] != k_no_index) {
            forces_.erase(at(nodes_[i]), static_cast<std::uint32_t>(i));
        }
        nodes_[i] = k_no_index;
    }
}

/// Every vertex has its block on the diagonal, also where no element is.
void SourceLists::touch_vertices(const ElementRooms& rooms) {
    for (std::size_t o = 0; o < vertex_counts_.size(); ++o) {
        const ElementRooms::Object& object = rooms.objects()[o];
        const auto [fewer, more] = std::minmax(vertex_counts_[o], object.count);
        for (std::size_t v = fewer; v < more; ++v) {
            is_present_[object.begin + v] = v < object.count ? 1 : 0;
            touch(static_cast<Index>(object.begin + v), k_neighbours | k_blocks | k_constants);
        }
    }
}

/// Parts a site from those that no element joins it with any more, and joins it with new ones, as
/// the present row has met them. These are touched as well, and will find it done.
void SourceLists::change_neighbours(std::size_t site) {
    for (RowEntry& entry : row_) {
        if (entry.is_met == 0) {
            part(site, {entry.site, entry.pair});
            entry.pair = k_no_index;
        } else if (entry.pair == k_no_index) {
            entry.pair = join(site, at(entry.site));
        }
    }
}

/// Returns the number of the new pair, into which nothing sums yet.
Index SourceLists::join(std::size_t site_a, std::size_t site_b) {
    auto pair = static_cast<Index>(blocks_.size());
    if (free_.empty()) {
        blocks_.add_list();
        constant_.push_back(0.0);
    } else {
        pair = free_.back();
        free_.pop_back();
        blocks_.assign(at(pair), {});
        constant_[at(pair)] = 0.0;
    }
    neighbours_.insert(site_a, {static_cast<Index>(site_b), pair});
    if (site_a != site_b) {
        neighbours_.insert(site_b, {static_cast<Index>(site_a), pair});
    }
    return pair;
}

void SourceLists::part(std::size_t site, const Neighbour& neighbour) {
    neighbours_.erase(site, neighbour);
    if (static_cast<Index>(site) != neighbour.site) {
        neighbours_.erase(at(neighbour.site), {static_cast<Index>(site), neighbour.pair});
    }
    free_.push_back(neighbour.pair);
}

} // namespace weft
