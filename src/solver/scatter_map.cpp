#include "solver/scatter_map.h"

#include <cassert>

namespace weft {

void ScatterMap::build(const AssemblyLayout& layout, std::span<const ElementSet> sets) {
    is_present_.assign(layout.slot_count(), 0);
    for (const AssemblyLayout::Object& object : layout.objects()) {
        std::fill_n(is_present_.begin() + static_cast<std::ptrdiff_t>(object.begin), object.count,
                    1);
    }
    mark_.assign(layout.slot_count(), {0, 0});
    last_mark_ = 0;
    dirty_.assign(layout.slot_count(), 0);
    changed_rows_ = 0;
    element_sources_.clear();
    most_nodes_ = 0;
    for (const AssemblyLayout::Set& set : layout.sets()) {
        element_sources_.push_back(set.block_sources());
        most_nodes_ = std::max(most_nodes_, set.nodes_per_element);
    }
    list_nodes(layout, sets);
    list_forces(layout);
    list_neighbours(layout);
    keep_counts(layout);
}

void ScatterMap::keep_counts(const AssemblyLayout& layout) {
    element_counts_.clear();
    for (const AssemblyLayout::Set& set : layout.sets()) {
        element_counts_.push_back(set.count);
    }
    vertex_counts_.clear();
    for (const AssemblyLayout::Object& object : layout.objects()) {
        vertex_counts_.push_back(object.count);
    }
}

void ScatterMap::list_nodes(const AssemblyLayout& layout, std::span<const ElementSet> sets) {
    nodes_.assign(layout.force_count(), k_no_index);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (std::size_t i = 0; i < sets[s].nodes.size(); ++i) {
            nodes_[layout.sets()[s].force_begin + i] = layout.slot_of_node(sets[s], i);
        }
    }
}

void ScatterMap::list_forces(const AssemblyLayout& layout) {
    std::vector<std::uint32_t> next(layout.slot_count(), 0);
    for (const Index slot : nodes_) {
        if (slot != k_no_index) {
            ++next[at(slot)];
        }
    }
    forces_.reset(next);
    std::fill(next.begin(), next.end(), 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i] != k_no_index) {
            const std::size_t slot = at(nodes_[i]);
            forces_[slot][next[slot]++] = static_cast<std::uint32_t>(i);
        }
    }
}

/// Calls f(set number, element, which of its nodes, its nodes) for each element at a slot that
/// matters to a row with these flags, in order; once for each of its nodes that stand there.
template <typename F>
void ScatterMap::for_each_element(const AssemblyLayout& layout,
                                  std::size_t slot,
                                  std::uint8_t dirty,
                                  const F& f) const {
    const std::span<const AssemblyLayout::Set> sets = layout.sets();
    std::size_t s = 0;
    for (const std::uint32_t force : forces_[slot]) {
        while (force >= sets[s].force_begin + sets[s].capacity * sets[s].nodes_per_element) {
            ++s;
        }
        const AssemblyLayout::Set& set = sets[s];
        if ((dirty & (k_neighbours | (set.is_constant ? k_constants : k_blocks))) == 0) {
            continue;
        }
        const auto within = static_cast<std::uint32_t>(force - set.force_begin);
        const std::uint32_t element = set.element_of(within);
        const auto n = static_cast<std::uint32_t>(set.nodes_per_element);
        const std::uint32_t k = within - element * n;
        f(s, element, k, std::span<const Index>(&nodes_[force - k], n));
    }
}

/// Makes a slot the current row, with the pairs that are known and none that elements join yet.
void ScatterMap::begin_row(std::size_t slot) {
    ++last_mark_;
    row_.clear();
    for (const Neighbour& known : neighbours_[slot]) {
        row_[entry_of(known.slot)].pair = known.pair;
    }
    if (is_present_[slot] != 0) {
        row_[entry_of(static_cast<Index>(slot))].is_joined = 1;
    }
}

std::uint32_t ScatterMap::add_neighbour(Index slot) {
    const auto entry = static_cast<std::uint32_t>(row_.size());
    mark_[at(slot)] = {last_mark_, entry};
    row_.push_back({.slot = slot});
    return entry;
}

/// Adds the slots that elements join with this one, and itself, to the current row.
void ScatterMap::find_neighbours(const AssemblyLayout& layout, std::size_t slot) {
    begin_row(slot);
    for_each_element(layout, slot, k_neighbours,
                     [&](std::size_t, std::uint32_t, std::uint32_t, std::span<const Index> nodes) {
                         for (const Index other : nodes) {
                             if (other != k_no_index) {
                                 entry_of(other);
                             }
                         }
                     });
}

void ScatterMap::list_neighbours(const AssemblyLayout& layout) {
    std::vector<Index> all;
    std::vector<std::uint32_t> lengths(layout.slot_count(), 0);
    neighbours_.reset(lengths);
    for (std::size_t slot = 0; slot < layout.slot_count(); ++slot) {
        find_neighbours(layout, slot);
        for (const RowEntry& entry : row_) {
            all.push_back(entry.slot);
        }
        std::sort(all.end() - static_cast<std::ptrdiff_t>(row_.size()), all.end());
        lengths[slot] = static_cast<std::uint32_t>(row_.size());
    }
    neighbours_.reset(lengths);
    auto next = all.begin();
    for (std::size_t slot = 0; slot < lengths.size(); ++slot) {
        for (Neighbour& neighbour : neighbours_[slot]) {
            neighbour = {*next++, k_no_index};
        }
    }
}

void ScatterMap::build_pairs(const AssemblyLayout& layout,
                             std::span<const ElementSet> sets,
                             std::span<const Index> slots) {
    blocks_.reset({});
    blocks_.keep_spare(false);
    constants_.clear();
    free_.clear();
    for (const Index slot : slots) {
        for (Neighbour& neighbour : neighbours_[at(slot)]) {
            if (neighbour.slot < slot) {
                continue; // numbered with the other row
            }
            neighbour.pair = static_cast<Index>(blocks_.size());
            const std::span<Neighbour> others = neighbours_[at(neighbour.slot)];
            std::lower_bound(others.begin(), others.end(), Neighbour{slot, 0})->pair =
                neighbour.pair;
            blocks_.add_list();
            constants_.push_back(0.0);
        }
        list_row(layout, sets, at(slot), k_blocks | k_constants);
    }
    blocks_.keep_spare(true);
}

/// Collects the neighbours of a row, and the blocks that sum into its pairs with those at no lower
/// slot. Unwanted blocks are written and then overwritten: a branch would be mispredicted.
void ScatterMap::gather_row(const AssemblyLayout& layout,
                            std::span<const ElementSet> sets,
                            std::size_t slot,
                            std::uint8_t dirty) {
    const auto own = static_cast<Index>(slot);
    gathered_.resize(std::max(gathered_.size(), forces_[slot].size() * most_nodes_ + 1));
    Gathered* next = gathered_.data();
    for_each_element(
        layout, slot, dirty,
        [&](std::size_t s, std::uint32_t element, std::uint32_t k, std::span<const Index> nodes) {
            const AssemblyLayout::Set& set = layout.sets()[s];
            const std::uint32_t* const sources = &element_sources_[s][k * nodes.size()];
            const std::size_t first = element * set.blocks_per_element;
            if (set.is_constant) {
                for (std::size_t j = 0; j < nodes.size(); ++j) {
                    if (nodes[j] != k_no_index) {
                        RowEntry& entry = row_[entry_of(nodes[j])];
                        entry.is_joined = 1;
                        entry.constant += sets[s].constants[first + sources[j] / k_placements];
                    }
                }
                return;
            }
            const auto first_source =
                k_placements * static_cast<std::uint32_t>(set.block_begin + first);
            for (std::size_t j = 0; j < nodes.size(); ++j) {
                if (nodes[j] != k_no_index) {
                    const std::uint32_t entry = entry_of(nodes[j]);
                    const std::uint32_t is_wanted = nodes[j] >= own ? 1 : 0;
                    *next = {entry, first_source + sources[j]};
                    next += is_wanted;
                    row_[entry].blocks += is_wanted;
                    row_[entry].is_joined = 1;
                }
            }
        });
    gathered_count_ = static_cast<std::size_t>(next - gathered_.data());
}

/// Rebuilds the parts of a row that are dirty.
void ScatterMap::list_row(const AssemblyLayout& layout,
                          std::span<const ElementSet> sets,
                          std::size_t slot,
                          std::uint8_t dirty) {
    begin_row(slot);
    gather_row(layout, sets, slot, dirty);
    if ((dirty & k_neighbours) != 0) {
        update_pairs(slot);
    }
    if ((dirty & k_blocks) != 0) {
        assign_blocks(slot);
    }
    for (const RowEntry& entry : row_) {
        if ((dirty & k_constants) != 0 && entry.slot >= static_cast<Index>(slot) &&
            entry.pair != k_no_index) {
            constants_[at(entry.pair)] = entry.constant;
        }
    }
}

/// Sorts the gathered blocks of a row by neighbour and gives them to the pairs.
void ScatterMap::assign_blocks(std::size_t slot) {
    std::uint32_t end = 0;
    for (RowEntry& entry : row_) {
        entry.end = end;
        end += entry.blocks;
    }
    sorted_sources_.resize(end);
    for (const Gathered& one : std::span(gathered_).first(gathered_count_)) {
        sorted_sources_[row_[one.entry].end++] = one.source;
    }
    for (const RowEntry& entry : row_) {
        if (entry.slot >= static_cast<Index>(slot) && entry.pair != k_no_index) {
            blocks_.assign(
                at(entry.pair),
                std::span(sorted_sources_).subspan(entry.end - entry.blocks, entry.blocks));
        }
    }
}

// When elements change.

void ScatterMap::remesh(const AssemblyLayout& layout,
                        std::span<const ElementSet> sets,
                        std::span<const std::vector<Index>> changed) {
    for (std::size_t s = 0; s < sets.size(); ++s) {
        for (std::size_t element = layout.sets()[s].count; element < element_counts_[s];
             ++element) {
            remove_nodes(layout, s, element);
        }
        for (const Index element : changed[s]) {
            replace_nodes(layout, sets[s], s, element);
        }
    }
    mark_vertices_dirty(layout);
    std::sort(dirty_slots_.begin(), dirty_slots_.end());
    for (const Index slot : dirty_slots_) {
        list_row(layout, sets, at(slot), dirty_[at(slot)]);
        changed_rows_ += (dirty_[at(slot)] & k_blocks) != 0 ? 1 : 0;
        dirty_[at(slot)] = 0;
    }
    dirty_slots_.clear();
    keep_counts(layout);
}

void ScatterMap::mark_dirty(Index slot, std::uint8_t dirty) {
    if (slot == k_no_index) {
        return;
    }
    if (dirty_[at(slot)] == 0) {
        dirty_slots_.push_back(slot);
    }
    dirty_[at(slot)] |= dirty;
}

/// Remembers the last object: the nodes of an element mostly belong to one.
Index ScatterMap::slot_of(const AssemblyLayout& layout, Index vertex) {
    const auto v = static_cast<std::size_t>(vertex);
    const AssemblyLayout::Object& last = layout.objects()[last_object_];
    if (v < last.first || v >= last.first + last.count) {
        last_object_ = layout.object_of(vertex);
    }
    const AssemblyLayout::Object& object = layout.objects()[last_object_];
    return static_cast<Index>(object.begin + v - object.first);
}

/// Gives an element the nodes that it has now. When these are the same as before, it changes the
/// map only where its blocks are constant.
void ScatterMap::replace_nodes(const AssemblyLayout& layout,
                               const ElementSet& set,
                               std::size_t s,
                               Index element) {
    const std::size_t n = layout.sets()[s].nodes_per_element;
    const std::size_t first = layout.sets()[s].force_begin + at(element) * n;
    now_.clear();
    for (const Index node : set.nodes.subspan(at(element) * n, n)) {
        now_.push_back(node == k_no_index ? k_no_index : slot_of(layout, node + set.first_vertex));
    }
    const bool is_other =
        !std::equal(now_.begin(), now_.end(), nodes_.begin() + static_cast<std::ptrdiff_t>(first));
    if (!is_other && !set.is_constant) {
        return;
    }
    const std::uint8_t kind = set.is_constant ? k_constants : k_blocks;
    const auto dirty = static_cast<std::uint8_t>(kind | (is_other ? k_neighbours : 0));
    for (std::size_t k = 0; k < n; ++k) {
        Index& node = nodes_[first + k];
        mark_dirty(node, dirty);
        if (node == now_[k]) {
            continue;
        }
        mark_dirty(now_[k], dirty);
        if (node != k_no_index) {
            forces_.erase(at(node), static_cast<std::uint32_t>(first + k));
        }
        if (now_[k] != k_no_index) {
            forces_.insert(at(now_[k]), static_cast<std::uint32_t>(first + k));
        }
        node = now_[k];
    }
}

void ScatterMap::remove_nodes(const AssemblyLayout& layout, std::size_t s, std::size_t element) {
    const AssemblyLayout::Set& set = layout.sets()[s];
    const std::size_t first = set.force_begin + element * set.nodes_per_element;
    for (std::size_t i = first; i < first + set.nodes_per_element; ++i) {
        mark_dirty(nodes_[i], k_neighbours | (set.is_constant ? k_constants : k_blocks));
        if (nodes_[i] != k_no_index) {
            forces_.erase(at(nodes_[i]), static_cast<std::uint32_t>(i));
        }
        nodes_[i] = k_no_index;
    }
}

/// Vertices that came or went: each vertex has its diagonal block, also where no element is.
void ScatterMap::mark_vertices_dirty(const AssemblyLayout& layout) {
    for (std::size_t o = 0; o < vertex_counts_.size(); ++o) {
        const AssemblyLayout::Object& object = layout.objects()[o];
        const auto [fewer, more] = std::minmax(vertex_counts_[o], object.count);
        for (std::size_t v = fewer; v < more; ++v) {
            is_present_[object.begin + v] = v < object.count ? 1 : 0;
            mark_dirty(static_cast<Index>(object.begin + v), k_neighbours | k_blocks | k_constants);
        }
    }
}

/// Removes the pairs of a slot that no element joins any more and adds those that are new, as the
/// current row has found them. The other slot is dirty too, and finds the pair up to date.
void ScatterMap::update_pairs(std::size_t slot) {
    for (RowEntry& entry : row_) {
        if (entry.is_joined == 0) {
            remove_pair(slot, {entry.slot, entry.pair});
            entry.pair = k_no_index;
        } else if (entry.pair == k_no_index) {
            entry.pair = add_pair(slot, at(entry.slot));
        }
    }
}

/// Returns the number of the new pair, which has no blocks yet.
Index ScatterMap::add_pair(std::size_t slot_a, std::size_t slot_b) {
    auto pair = static_cast<Index>(blocks_.size());
    if (free_.empty()) {
        blocks_.add_list();
        constants_.push_back(0.0);
    } else {
        pair = free_.back();
        free_.pop_back();
        blocks_.assign(at(pair), {});
        constants_[at(pair)] = 0.0;
    }
    neighbours_.insert(slot_a, {static_cast<Index>(slot_b), pair});
    if (slot_a != slot_b) {
        neighbours_.insert(slot_b, {static_cast<Index>(slot_a), pair});
    }
    return pair;
}

void ScatterMap::remove_pair(std::size_t slot, const Neighbour& neighbour) {
    neighbours_.erase(slot, neighbour);
    if (static_cast<Index>(slot) != neighbour.slot) {
        neighbours_.erase(at(neighbour.slot), {static_cast<Index>(slot), neighbour.pair});
    }
    free_.push_back(neighbour.pair);
}

} // namespace weft
