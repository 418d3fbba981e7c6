#include "step/source_lists.h"

#include <array>
#include <cassert>

namespace weft {

namespace {

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

constexpr unsigned k_all = ~0U;

/// Calls f(block of the element, site a, site b, on its diagonal) for each block that has both
/// nodes.
template <typename F> void for_each_block(std::span<const Index> nodes, const F& f) {
    std::size_t block = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
        for (std::size_t b = a; b < nodes.size(); ++b, ++block) {
            if (nodes[a] != k_no_index && nodes[b] != k_no_index) {
                f(block, nodes[a], nodes[b], a == b);
            }
        }
    }
}

/// The same with whether the block has a node among those `moved`.
template <typename F>
void for_each_block(std::span<const Index> nodes, unsigned moved, const F& f) {
    std::size_t block = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
        for (std::size_t b = a; b < nodes.size(); ++b, ++block) {
            if (nodes[a] != k_no_index && nodes[b] != k_no_index) {
                f(block, nodes[a], nodes[b], a == b, ((moved >> a | moved >> b) & 1U) != 0);
            }
        }
    }
}

/// Calls f(source) with what sums into the pair of sites (a, b) from a block: itself or its
/// transpose, and both where one vertex stands at two nodes of the element.
template <typename F>
void for_each_source(std::size_t block, Index a, Index b, bool on_diagonal, const F& f) {
    const auto source = static_cast<std::uint32_t>(2 * block);
    if (a <= b) {
        f(source);
    }
    if (a > b || (a == b && !on_diagonal)) {
        f(source + 1);
    }
}

} // namespace

void SourceLists::build(const ElementRooms& rooms, std::span<const ElementSet> sets) {
    find_nodes(rooms, sets);
    list_forces(rooms);
    list_neighbours(rooms);
    altered_.resize(sets.size());
    altered_count_ = 0;
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

void SourceLists::find_nodes(const ElementRooms& rooms, std::span<const ElementSet> sets) {
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

void SourceLists::list_neighbours(const ElementRooms& rooms) {
    std::vector<Index> found;
    std::vector<std::uint32_t> lengths(rooms.site_count(), 0);
    std::vector<Index> seen_from(rooms.site_count(), k_no_index);
    const auto look = [&](std::size_t site, Index other) {
        if (other != k_no_index && seen_from[at(other)] != static_cast<Index>(site)) {
            seen_from[at(other)] = static_cast<Index>(site);
            found.push_back(other);
        }
    };
    for (const ElementRooms::Object& object : rooms.objects()) {
        for (std::size_t site = object.begin; site < object.begin + object.count; ++site) {
            const std::size_t first = found.size();
            look(site, static_cast<Index>(site));
            auto set = rooms.sets().begin();
            for (const std::uint32_t force : forces_[site]) {
                while (force >= set->force_begin + set->capacity * set->nodes_per_element) {
                    ++set;
                }
                const std::size_t k = (force - set->force_begin) % set->nodes_per_element;
                for (std::size_t a = 0; a < set->nodes_per_element; ++a) {
                    look(site, nodes_[force - k + a]);
                }
            }
            std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end());
            lengths[site] = static_cast<std::uint32_t>(found.size() - first);
        }
    }
    neighbours_.reset(lengths);
    auto next = found.begin();
    for (std::size_t site = 0; site < lengths.size(); ++site) {
        for (Neighbour& neighbour : neighbours_[site]) {
            neighbour = {*next++, k_no_index};
        }
    }
}

void SourceLists::number_pairs(const ElementRooms& rooms,
                               std::span<const ElementSet> sets,
                               std::span<const Index> sites,
                               std::span<const Index> row_of_site) {
    sites_.clear();
    for (std::size_t row = 0; row < sites.size(); ++row) {
        const Index site = sites[row];
        for (Neighbour& neighbour : neighbours_[at(site)]) {
            if (row_of_site[at(neighbour.site)] < static_cast<Index>(row)) {
                continue;
            }
            neighbour.pair = static_cast<Index>(sites_.size());
            sites_.push_back({std::min(site, neighbour.site), std::max(site, neighbour.site)});
            const std::span<Neighbour> others = neighbours_[at(neighbour.site)];
            std::lower_bound(others.begin(), others.end(), Neighbour{site, 0})->pair =
                neighbour.pair;
        }
    }
    list_blocks(rooms, false, blocks_);
    list_blocks(rooms, true, constants_);
    constant_.resize(sites_.size());
    for (std::size_t pair = 0; pair < sites_.size(); ++pair) {
        sum_constants(rooms, sets, static_cast<Index>(pair));
    }
    is_touched_.assign(sites_.size(), 0);
    free_.clear();
}

void SourceLists::list_blocks(const ElementRooms& rooms,
                              bool constant,
                              ListPool<std::uint32_t>& lists) {
    std::vector<std::pair<Index, std::uint32_t>> found; // pair and source, by ascending source
    std::vector<std::uint32_t> next(sites_.size(), 0);
    for (const ElementRooms::Set& set : rooms.sets()) {
        if (set.is_constant != constant) {
            continue;
        }
        for (std::size_t e = 0; e < set.count; ++e) {
            for_each_block(nodes_of(set, e), [&](std::size_t block, Index a, Index b, bool same) {
                const Index pair = pair_of(at(a), at(b));
                for_each_source(set.block_begin + e * set.blocks_per_element + block, a, b, same,
                                [&](std::uint32_t source) {
                                    found.emplace_back(pair, source);
                                    ++next[at(pair)];
                                });
            });
        }
    }
    lists.reset(next);
    std::fill(next.begin(), next.end(), 0);
    for (const auto& [pair, source] : found) {
        lists[at(pair)][next[at(pair)]++] = source;
    }
}

void SourceLists::sum_constants(const ElementRooms& rooms,
                                std::span<const ElementSet> sets,
                                Index pair) {
    double sum = 0.0;
    std::size_t s = 0;
    const auto holds = [&](std::size_t block) {
        const ElementRooms::Set& set = rooms.sets()[s];
        return set.is_constant && block < set.block_begin + set.capacity * set.blocks_per_element;
    };
    for (const std::uint32_t source : constants_[at(pair)]) {
        const std::size_t block = source / 2;
        while (!holds(block)) {
            ++s;
        }
        sum += sets[s].constants[block - rooms.sets()[s].block_begin];
    }
    constant_[at(pair)] = sum;
}

Index SourceLists::pair_of(std::size_t site_a, std::size_t site_b) const {
    const auto others = neighbours_[site_a];
    const auto found =
        std::lower_bound(others.begin(), others.end(), Neighbour{static_cast<Index>(site_b), 0});
    return found != others.end() && found->site == static_cast<Index>(site_b) ? found->pair
                                                                              : k_no_index;
}

Index SourceLists::join(std::size_t site_a, std::size_t site_b) {
    const Index found = pair_of(site_a, site_b);
    if (found != k_no_index) {
        return found;
    }
    auto pair = static_cast<Index>(sites_.size());
    if (free_.empty()) {
        sites_.emplace_back();
        blocks_.add_list();
        constants_.add_list();
        constant_.push_back(0.0);
        is_touched_.push_back(0);
    } else {
        pair = free_.back();
        free_.pop_back();
    }
    const auto a = static_cast<Index>(std::min(site_a, site_b));
    const auto b = static_cast<Index>(std::max(site_a, site_b));
    sites_[at(pair)] = {a, b};
    neighbours_.insert(at(a), {b, pair});
    if (a != b) {
        neighbours_.insert(at(b), {a, pair});
    }
    return pair;
}

void SourceLists::part(Index pair) {
    const auto [a, b] = sites_[at(pair)];
    neighbours_.erase(at(a), {b, pair});
    if (a != b) {
        neighbours_.erase(at(b), {a, pair});
    }
    constant_[at(pair)] = 0.0;
    free_.push_back(pair);
}

void SourceLists::touch(Index pair) {
    if (is_touched_[at(pair)] == 0) {
        is_touched_[at(pair)] = 1;
        touched_.push_back(pair);
    }
}

/// Takes what has to do with the moved nodes out of the lists. The other constants may have become
/// others.
void SourceLists::take_out(const ElementRooms::Set& set, std::size_t slot, unsigned moved) {
    const std::span<const Index> nodes = nodes_of(set, slot);
    ListPool<std::uint32_t>& lists = set.is_constant ? constants_ : blocks_;
    const std::size_t first = set.block_begin + slot * set.blocks_per_element;
    for_each_block(nodes, moved, [&](std::size_t block, Index a, Index b, bool same, bool goes) {
        if (goes || set.is_constant) {
            const Index pair = pair_of(at(a), at(b));
            touch(pair);
            if (goes) {
                for_each_source(first + block, a, b, same,
                                [&](std::uint32_t source) { lists.erase(at(pair), source); });
            }
        }
    });
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (nodes[k] != k_no_index && ((moved >> k) & 1U) != 0) {
            const std::size_t force = set.force_begin + slot * set.nodes_per_element + k;
            forces_.erase(at(nodes[k]), static_cast<std::uint32_t>(force));
        }
    }
}

void SourceLists::put_in(const ElementRooms::Set& set, std::size_t slot, unsigned moved) {
    const std::span<const Index> nodes = nodes_of(set, slot);
    ListPool<std::uint32_t>& lists = set.is_constant ? constants_ : blocks_;
    const std::size_t first = set.block_begin + slot * set.blocks_per_element;
    for_each_block(nodes, moved, [&](std::size_t block, Index a, Index b, bool same, bool comes) {
        if (comes) {
            const Index pair = join(at(a), at(b));
            touch(pair);
            for_each_source(first + block, a, b, same,
                            [&](std::uint32_t source) { lists.insert(at(pair), source); });
        }
    });
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (nodes[k] != k_no_index && ((moved >> k) & 1U) != 0) {
            const std::size_t force = set.force_begin + slot * set.nodes_per_element + k;
            forces_.insert(at(nodes[k]), static_cast<std::uint32_t>(force));
        }
    }
}

void SourceLists::change(const ElementRooms& rooms,
                         std::span<const ElementSet> sets,
                         std::span<const std::vector<Index>> changed) {
    take_out_altered(rooms, sets, changed);
    add_and_remove_vertices(rooms);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (const Altered& element : altered_[s]) {
            put_in(rooms.sets()[s], at(element.slot), element.moved);
        }
    }
    settle_touched(rooms, sets);
    keep_counts(rooms);
}

/// Takes out the elements that are gone, and of those that changed what has to do with the nodes
/// that they have no more; notes their new nodes.
void SourceLists::take_out_altered(const ElementRooms& rooms,
                                   std::span<const ElementSet> sets,
                                   std::span<const std::vector<Index>> changed) {
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const ElementRooms::Set& set = rooms.sets()[s];
        for (std::size_t slot = set.count; slot < element_counts_[s]; ++slot) {
            take_out(set, slot, k_all);
            ++altered_count_;
            std::ranges::fill(nodes_of(set, slot), k_no_index);
        }
        altered_[s].clear();
        for (const Index slot : changed[s]) {
            const std::span<Index> nodes = nodes_of(set, at(slot));
            std::array<Index, 8> now{};
            assert(nodes.size() <= now.size());
            unsigned moved = 0;
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                now[k] = rooms.site_of_node(sets[s], at(slot) * nodes.size() + k);
                moved |= now[k] != nodes[k] ? 1U << k : 0U;
            }
            take_out(set, at(slot), moved);
            std::copy_n(now.begin(), nodes.size(), nodes.begin());
            altered_[s].push_back({slot, moved});
            altered_count_ += moved != 0 ? 1 : 0;
        }
    }
}

/// Every vertex has its block on the diagonal, also where no element is.
void SourceLists::add_and_remove_vertices(const ElementRooms& rooms) {
    for (std::size_t o = 0; o < vertex_counts_.size(); ++o) {
        const ElementRooms::Object& object = rooms.objects()[o];
        for (std::size_t v = object.count; v < vertex_counts_[o]; ++v) {
            part(pair_of(object.begin + v, object.begin + v));
        }
        for (std::size_t v = vertex_counts_[o]; v < object.count; ++v) {
            join(object.begin + v, object.begin + v);
        }
    }
}

void SourceLists::settle_touched(const ElementRooms& rooms, std::span<const ElementSet> sets) {
    for (const Index pair : touched_) {
        is_touched_[at(pair)] = 0;
        const auto [a, b] = sites_[at(pair)];
        if (a != b && blocks_[at(pair)].empty() && constants_[at(pair)].empty()) {
            part(pair);
        } else {
            sum_constants(rooms, sets, pair);
        }
    }
    touched_.clear();
}

} // namespace weft
