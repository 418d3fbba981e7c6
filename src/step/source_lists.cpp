#include "step/source_lists.h"

#include <cassert>

namespace weft {

namespace {

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

} // namespace

void SourceLists::build(const ElementRooms& rooms, std::span<const ElementSet> sets) {
    is_present_.assign(rooms.site_count(), 0);
    for (const ElementRooms::Object& object : rooms.objects()) {
        std::fill_n(is_present_.begin() + static_cast<std::ptrdiff_t>(object.begin), object.count,
                    1);
    }
    mark_.assign(rooms.site_count(), 0);
    last_mark_ = 0;
    place_.resize(rooms.site_count());
    is_touched_.assign(rooms.site_count(), 0);
    changed_rows_ = 0;
    list_nodes(rooms, sets);
    list_forces(rooms);
    list_neighbours(rooms);
    keep_counts(rooms);
}

void SourceLists::keep_counts(const ElementRooms& rooms) {
    element_counts_.clear();
    for (const ElementRooms::Set& set : rooms.sets()) {
        element_counts_.push_back(set.count);
    }
    vertex_counts_.clear();
    for (const ElementRooms::Object& object : rooms.objects()) {
        vertex_counts_.push_back(object.count);
    }
}

void SourceLists::list_nodes(const ElementRooms& rooms, std::span<const ElementSet> sets) {
    nodes_.assign(rooms.force_count(), k_no_index);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (std::size_t i = 0; i < sets[s].nodes.size(); ++i) {
            nodes_[rooms.sets()[s].force_begin + i] = rooms.site_of_node(sets[s], i);
        }
    }
}

void SourceLists::list_forces(const ElementRooms& rooms) {
    std::vector<std::uint32_t> next(rooms.site_count(), 0);
    for (const Index site : nodes_) {
        if (site != k_no_index) {
            ++next[at(site)];
        }
    }
    forces_.reset(next);
    std::fill(next.begin(), next.end(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i] != k_no_index) {
            const std::size_t site = at(nodes_[i]);
            forces_[site][next[site]++] = static_cast<std::uint32_t>(i);
        }
    }
}

/// Calls f(set number, element, which of its nodes, its nodes) for each element at a site, in
/// order; once for each of its nodes that stand there.
template <typename F>
void SourceLists::for_each_element(const ElementRooms& rooms, std::size_t site, const F& f) const {
    std::size_t s = 0;
    for (const std::uint32_t force : forces_[site]) {
        const ElementRooms::Set* set = &rooms.sets()[s];
        while (force >= set->force_begin + set->capacity * set->nodes_per_element) {
            set = &rooms.sets()[++s];
        }
        const auto n = static_cast<std::uint32_t>(set->nodes_per_element);
        const auto within = static_cast<std::uint32_t>(force - set->force_begin);
        const std::uint32_t element = within / n; // 32 bits: half the time of 64
        const std::uint32_t k = within - element * n;
        f(s, element, k, std::span<const Index>(&nodes_[force - k], n));
    }
}

/// Sites that elements join with this one, and itself, to found_, in any order.
void SourceLists::find_neighbours(const ElementRooms& rooms, std::size_t site) {
    found_.clear();
    ++last_mark_;
    const auto look = [&](Index other) {
        if (other != k_no_index && mark_[at(other)] != last_mark_) {
            mark_[at(other)] = last_mark_;
            found_.push_back(other);
        }
    };
    if (is_present_[site] != 0) {
        look(static_cast<Index>(site));
    }
    for_each_element(rooms, site,
                     [&](std::size_t, std::uint32_t, std::uint32_t, std::span<const Index> nodes) {
                         for (const Index other : nodes) {
                             look(other);
                         }
                     });
}

void SourceLists::list_neighbours(const ElementRooms& rooms) {
    std::vector<Index> all;
    std::vector<std::uint32_t> lengths(rooms.site_count(), 0);
    for (std::size_t site = 0; site < rooms.site_count(); ++site) {
        find_neighbours(rooms, site);
        std::sort(found_.begin(), found_.end());
        all.insert(all.end(), found_.begin(), found_.end());
        lengths[site] = static_cast<std::uint32_t>(found_.size());
    }
    neighbours_.reset(lengths);
    auto next = all.begin();
    for (std::size_t site = 0; site < lengths.size(); ++site) {
        for (Neighbour& neighbour : neighbours_[site]) {
            neighbour = {*next++, k_no_index};
        }
    }
}

void SourceLists::build_pairs(const ElementRooms& rooms,
                              std::span<const ElementSet> sets,
                              std::span<const Index> sites) {
    blocks_.reset({});
    blocks_.keep_room_to_spare(false);
    constant_.clear();
    free_.clear();
    for (const Index site : sites) {
        for (Neighbour& neighbour : neighbours_[at(site)]) {
            if (neighbour.site < site) {
                continue; // numbered with the other row
            }
            neighbour.pair = static_cast<Index>(blocks_.size());
            const std::span<Neighbour> others = neighbours_[at(neighbour.site)];
            std::lower_bound(others.begin(), others.end(), Neighbour{site, 0})->pair =
                neighbour.pair;
            blocks_.add_list();
            constant_.push_back(0.0);
        }
        list_row(rooms, sets, at(site));
    }
    blocks_.keep_room_to_spare(true);
}

/// Lists what sums into the pairs of this site with itself and with higher ones.
void SourceLists::list_row(const ElementRooms& rooms,
                           std::span<const ElementSet> sets,
                           std::size_t site) {
    const std::span<const Neighbour> row = neighbours_[site];
    if (row_blocks_.size() < row.size()) {
        row_blocks_.resize(row.size());
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
        place_[at(row[i].site)] = static_cast<std::uint32_t>(i);
        if (row[i].site >= static_cast<Index>(site)) {
            row_blocks_[i].clear();
            constant_[at(row[i].pair)] = 0.0;
        }
    }
    for_each_element(
        rooms, site,
        [&](std::size_t s, std::uint32_t element, std::size_t k, std::span<const Index> nodes) {
            const ElementRooms::Set& set = rooms.sets()[s];
            const std::size_t first = element * set.blocks_per_element;
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                if (nodes[j] < static_cast<Index>(site)) {
                    continue; // none, or of another row
                }
                const std::size_t low = std::min(k, j);
                const std::size_t block =
                    set.is_difference
                        ? first
                        : first + low * nodes.size() - low * (low + 1) / 2 + std::max(k, j);
                const std::uint32_t manner = set.is_difference ? (k == j ? k_as_it_is : k_negative)
                                             : k > j           ? k_transposed
                                                               : k_as_it_is;
                const std::uint32_t neighbour = place_[at(nodes[j])];
                if (set.is_constant) {
                    constant_[at(row[neighbour].pair)] += sets[s].constants[block];
                } else {
                    row_blocks_[neighbour].push_back(
                        k_manners * static_cast<std::uint32_t>(set.block_begin + block) + manner);
                }
            }
        });
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i].site >= static_cast<Index>(site)) {
            blocks_.assign(at(row[i].pair), row_blocks_[i]);
        }
    }
}

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
        change_neighbours(rooms, at(site));
    }
    for (const Index site : touched_) {
        list_row(rooms, sets, at(site));
        is_touched_[at(site)] = 0;
    }
    changed_rows_ += touched_.size();
    touched_.clear();
    keep_counts(rooms);
}

void SourceLists::touch(Index site) {
    if (site != k_no_index && is_touched_[at(site)] == 0) {
        is_touched_[at(site)] = 1;
        touched_.push_back(site);
    }
}

/// Gives an element the nodes that it has now. One that joins the same nodes as before only
/// matters when its blocks are constant.
void SourceLists::change_nodes(const ElementRooms& rooms,
                               const ElementSet& set,
                               std::size_t s,
                               Index slot) {
    const std::size_t n = rooms.sets()[s].nodes_per_element;
    const std::size_t first = rooms.sets()[s].force_begin + at(slot) * n;
    bool is_other = set.is_constant;
    for (std::size_t k = 0; k < n; ++k) {
        is_other = is_other || nodes_[first + k] != rooms.site_of_node(set, at(slot) * n + k);
    }
    for (std::size_t k = 0; k < n && is_other; ++k) {
        Index& node = nodes_[first + k];
        const Index now = rooms.site_of_node(set, at(slot) * n + k);
        touch(node);
        touch(now);
        if (node != now && node != k_no_index) {
            forces_.erase(at(node), static_cast<std::uint32_t>(first + k));
        }
        if (node != now && now != k_no_index) {
            forces_.insert(at(now), static_cast<std::uint32_t>(first + k));
        }
        node = now;
    }
}

void SourceLists::remove_nodes(const ElementRooms& rooms, std::size_t s, std::size_t slot) {
    const std::size_t n = rooms.sets()[s].nodes_per_element;
    const std::size_t first = rooms.sets()[s].force_begin + slot * n;
    for (std::size_t i = first; i < first + n; ++i) {
        touch(nodes_[i]);
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
            touch(static_cast<Index>(object.begin + v));
        }
    }
}

/// Parts a site from those that no element joins it with any more, and joins it with new ones.
/// These are touched as well, and will find it done.
void SourceLists::change_neighbours(const ElementRooms& rooms, std::size_t site) {
    find_neighbours(rooms, site);
    const std::span<const Neighbour> row = neighbours_[site];
    old_row_.assign(row.begin(), row.end());
    for (const Neighbour& neighbour : old_row_) {
        if (mark_[at(neighbour.site)] != last_mark_) {
            part(site, neighbour);
        }
        mark_[at(neighbour.site)] = 0; // known
    }
    for (const Index other : found_) {
        if (mark_[at(other)] == last_mark_) {
            join(site, at(other));
        }
    }
}

void SourceLists::join(std::size_t site_a, std::size_t site_b) {
    auto pair = static_cast<Index>(blocks_.size());
    if (free_.empty()) {
        blocks_.add_list();
        constant_.push_back(0.0);
    } else {
        pair = free_.back();
        free_.pop_back();
    }
    neighbours_.insert(site_a, {static_cast<Index>(site_b), pair});
    if (site_a != site_b) {
        neighbours_.insert(site_b, {static_cast<Index>(site_a), pair});
    }
}

void SourceLists::part(std::size_t site, const Neighbour& neighbour) {
    neighbours_.erase(site, neighbour);
    if (static_cast<Index>(site) != neighbour.site) {
        neighbours_.erase(at(neighbour.site), {static_cast<Index>(site), neighbour.pair});
    }
    free_.push_back(neighbour.pair);
}

} // namespace weft
