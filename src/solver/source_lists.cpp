#include "solver/source_lists.h"

#include <cassert>

namespace weft {

void SourceLists::build(const ElementRooms& rooms, std::span<const ElementSet> sets) {
    is_present_.assign(rooms.site_count(), 0);
    for (const ElementRooms::Object& object : rooms.objects()) {
        std::fill_n(is_present_.begin() + static_cast<std::ptrdiff_t>(object.begin), object.count,
                    1);
    }
    mark_.assign(rooms.site_count(), {0, 0});
    last_mark_ = 0;
    needs_.assign(rooms.site_count(), 0);
    changed_rows_ = 0;
    number_sources(rooms);
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

/// Of each node of an element with each.
void SourceLists::number_sources(const ElementRooms& rooms) {
    sources_.clear();
    most_nodes_ = 0;
    for (const ElementRooms::Set& set : rooms.sets()) {
        const std::size_t n = set.nodes_per_element;
        most_nodes_ = std::max(most_nodes_, n);
        std::vector<std::uint32_t>& sources = sources_.emplace_back();
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t j = 0; j < n; ++j) {
                const std::size_t low = std::min(k, j);
                const std::size_t block = low * n - low * (low + 1) / 2 + std::max(k, j);
                const std::uint32_t manner = k > j ? k_transposed : k_as_it_is;
                sources.push_back(set.is_difference
                                      ? (k == j ? k_as_it_is : k_negative)
                                      : k_manners * static_cast<std::uint32_t>(block) + manner);
            }
        }
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

/// Calls f(set number, element, which of its nodes, its nodes) for each element at a site that the
/// needs ask for, in order; once for each of its nodes that stand there.
template <typename F>
void SourceLists::for_each_element(const ElementRooms& rooms,
                                   std::size_t site,
                                   std::uint8_t needs,
                                   const F& f) const {
    const std::span<const ElementRooms::Set> sets = rooms.sets();
    std::size_t s = 0;
    for (const std::uint32_t force : forces_[site]) {
        while (force >= sets[s].force_begin + sets[s].capacity * sets[s].nodes_per_element) {
            ++s;
        }
        const ElementRooms::Set& set = sets[s];
        if ((needs & (k_neighbours | (set.is_constant ? k_constants : k_blocks))) == 0) {
            continue;
        }
        const auto within = static_cast<std::uint32_t>(force - set.force_begin);
        const std::uint32_t element = set.element_of(within);
        const auto n = static_cast<std::uint32_t>(set.nodes_per_element);
        const std::uint32_t k = within - element * n;
        f(s, element, k, std::span<const Index>(&nodes_[force - k], n));
    }
}

/// The present row is that of a site which nothing joins but what is known of it.
void SourceLists::begin_row(std::size_t site) {
    ++last_mark_;
    row_.clear();
    for (const Neighbour& known : neighbours_[site]) {
        row_[place_of(known.site)].pair = known.pair;
    }
    if (is_present_[site] != 0) {
        row_[place_of(static_cast<Index>(site))].is_met = 1;
    }
}

std::uint32_t SourceLists::add_neighbour(Index site) {
    const auto place = static_cast<std::uint32_t>(row_.size());
    mark_[at(site)] = {last_mark_, place};
    row_.push_back({.site = site});
    return place;
}

/// Sites that elements join with this one, and itself, to the present row.
void SourceLists::find_neighbours(const ElementRooms& rooms, std::size_t site) {
    begin_row(site);
    for_each_element(rooms, site, k_neighbours,
                     [&](std::size_t, std::uint32_t, std::uint32_t, std::span<const Index> nodes) {
                         for (const Index other : nodes) {
                             if (other != k_no_index) {
                                 place_of(other);
                             }
                         }
                     });
}

void SourceLists::list_neighbours(const ElementRooms& rooms) {
    std::vector<Index> all;
    std::vector<std::uint32_t> lengths(rooms.site_count(), 0);
    neighbours_.reset(lengths);
    for (std::size_t site = 0; site < rooms.site_count(); ++site) {
        find_neighbours(rooms, site);
        for (const RowEntry& entry : row_) {
            all.push_back(entry.site);
        }
        std::sort(all.end() - static_cast<std::ptrdiff_t>(row_.size()), all.end());
        lengths[site] = static_cast<std::uint32_t>(row_.size());
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
        list_row(rooms, sets, at(site), k_blocks | k_constants);
    }
    blocks_.keep_room_to_spare(true);
}

/// Collects the neighbours of a row, and what sums into its pairs with those at no lower site. What
/// is not wanted is written and then passed over, as branches by site could not be foreseen.
void SourceLists::gather_row(const ElementRooms& rooms,
                             std::span<const ElementSet> sets,
                             std::size_t site,
                             std::uint8_t needs) {
    const auto own = static_cast<Index>(site);
    gathered_.resize(std::max(gathered_.size(), forces_[site].size() * most_nodes_ + 1));
    Gathered* next = gathered_.data();
    for_each_element(
        rooms, site, needs,
        [&](std::size_t s, std::uint32_t element, std::uint32_t k, std::span<const Index> nodes) {
            const ElementRooms::Set& set = rooms.sets()[s];
            const std::uint32_t* const sources = &sources_[s][k * nodes.size()];
            const std::size_t first = element * set.blocks_per_element;
            if (set.is_constant) {
                for (std::size_t j = 0; j < nodes.size(); ++j) {
                    if (nodes[j] != k_no_index) {
                        RowEntry& entry = row_[place_of(nodes[j])];
                        entry.is_met = 1;
                        entry.constant += sets[s].constants[first + sources[j] / k_manners];
                    }
                }
                return;
            }
            const auto first_source =
                k_manners * static_cast<std::uint32_t>(set.block_begin + first);
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                if (nodes[j] != k_no_index) {
                    const std::uint32_t place = place_of(nodes[j]);
                    const std::uint32_t is_wanted = nodes[j] >= own ? 1 : 0;
                    *next = {place, first_source + sources[j]};
                    next += is_wanted;
                    row_[place].blocks += is_wanted;
                    row_[place].is_met = 1;
                }
            }
        });
    gathered_count_ = static_cast<std::size_t>(next - gathered_.data());
}

/// Does anew what a row needs.
void SourceLists::list_row(const ElementRooms& rooms,
                           std::span<const ElementSet> sets,
                           std::size_t site,
                           std::uint8_t needs) {
    begin_row(site);
    gather_row(rooms, sets, site, needs);
    if ((needs & k_neighbours) != 0) {
        change_neighbours(site);
    }
    if ((needs & k_blocks) != 0) {
        assign_blocks(site);
    }
    for (const RowEntry& entry : row_) {
        if ((needs & k_constants) != 0 && entry.site >= static_cast<Index>(site) &&
            entry.pair != k_no_index) {
            constant_[at(entry.pair)] = entry.constant;
        }
    }
}

/// Deals what was gathered of a row out to its pairs.
void SourceLists::assign_blocks(std::size_t site) {
    std::uint32_t end = 0;
    for (RowEntry& entry : row_) {
        entry.end = end;
        end += entry.blocks;
    }
    dealt_.resize(end);
    for (const Gathered& one : std::span(gathered_).first(gathered_count_)) {
        dealt_[row_[one.place].end++] = one.source;
    }
    for (const RowEntry& entry : row_) {
        if (entry.site >= static_cast<Index>(site) && entry.pair != k_no_index) {
            blocks_.assign(at(entry.pair),
                           std::span(dealt_).subspan(entry.end - entry.blocks, entry.blocks));
        }
    }
}

} // namespace weft
