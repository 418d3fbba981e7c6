#include "adapt/change_log.h"

#include "state/body.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace weft {

namespace {

bool are_same(const RestTriangle& a, const RestTriangle& b) {
    return a.inverse_edges == b.inverse_edges && a.area == b.area;
}

bool are_same(const MeshEdge& a, const MeshEdge& b) {
    return a.v == b.v && a.triangle == b.triangle && a.apex == b.apex;
}

/// Adds the slots that were not there at begin.
void add_new_slots(Index count_before, std::size_t count, std::vector<Index>& slots) {
    std::sort(slots.begin(), slots.end());
    for (Index i = count_before; i < static_cast<Index>(count); ++i) {
        slots.push_back(i);
    }
}

} // namespace

void ChangeLog::begin(const Cloth& cloth) {
    for (const OldTriangle& old : triangles_) {
        is_triangle_touched_[at(old.slot)] = 0;
    }
    for (const OldEdge& old : edges_) {
        is_edge_touched_[at(old.slot)] = 0;
    }
    triangles_.clear();
    edges_.clear();
    moved_.clear();
    vertex_count_ = cloth.vertex_count;
    triangle_count_ = static_cast<Index>(cloth.triangles.size());
    edge_count_ = static_cast<Index>(cloth.topology.edges.size());
    is_triangle_touched_.resize(at(triangle_count_), 0);
    is_edge_touched_.resize(at(edge_count_), 0);
}

void ChangeLog::touch_triangle(const Cloth& cloth, Index t) {
    if (t < triangle_count_ && is_triangle_touched_[at(t)] == 0) {
        is_triangle_touched_[at(t)] = 1;
        triangles_.push_back({t, cloth.triangles[at(t)], cloth.rest[at(t)]});
    }
    for (const Index e : cloth.topology.triangle_edges[at(t)]) {
        touch_edge(cloth, e);
    }
}

void ChangeLog::touch_edge(const Cloth& cloth, Index e) {
    if (e < edge_count_ && is_edge_touched_[at(e)] == 0) {
        is_edge_touched_[at(e)] = 1;
        edges_.push_back({e, cloth.topology.edges[at(e)]});
    }
}

void ChangeLog::move_vertex(Index from, Index to) {
    if (to < vertex_count_) {
        moved_.push_back({to, from < vertex_count_ ? from : k_no_index});
    }
}

ClothChanges ChangeLog::changes(const Cloth& cloth) const {
    ClothChanges changes;
    for (const ClothChanges::Vertex& moved : moved_) {
        if (moved.slot < cloth.vertex_count) {
            changes.vertices.push_back(moved);
        }
    }
    std::sort(changes.vertices.begin(), changes.vertices.end(),
              [](const auto& a, const auto& b) { return a.slot < b.slot; });
    for (Index v = vertex_count_; v < cloth.vertex_count; ++v) {
        changes.vertices.push_back({v, k_no_index});
    }
    for (const OldTriangle& old : triangles_) {
        if (at(old.slot) < cloth.triangles.size() &&
            (old.corners != cloth.triangles[at(old.slot)] ||
             !are_same(old.rest, cloth.rest[at(old.slot)]))) {
            changes.triangles.push_back(old.slot);
        }
    }
    add_new_slots(triangle_count_, cloth.triangles.size(), changes.triangles);
    for (const OldEdge& old : edges_) {
        if (at(old.slot) < cloth.topology.edges.size() &&
            !are_same(old.edge, cloth.topology.edges[at(old.slot)])) {
            changes.edges.push_back(old.slot);
        }
    }
    add_new_slots(edge_count_, cloth.topology.edges.size(), changes.edges);
    return changes;
}

std::vector<Index> ChangeLog::touched_vertices(const Cloth& cloth) const {
    std::vector<Index> vertices;
    const auto add = [&](const Triangle& corners) {
        for (const Index v : corners) {
            if (v != k_no_index && v < cloth.vertex_count) {
                vertices.push_back(v);
            }
        }
    };
    for (const OldTriangle& old : triangles_) {
        if (at(old.slot) < cloth.triangles.size()) {
            add(cloth.triangles[at(old.slot)]);
        }
    }
    for (std::size_t t = at(triangle_count_); t < cloth.triangles.size(); ++t) {
        add(cloth.triangles[t]);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

namespace {

/// Slot in which each old vertex of the cloth stands now; k_no_index: it is gone.
std::vector<Index>
slots_of_old(std::size_t old_count, std::size_t count, const ClothChanges& changes) {
    std::vector<Index> slots(old_count, k_no_index);
    std::iota(slots.begin(), slots.begin() + static_cast<long>(std::min(old_count, count)), 0);
    for (const ClothChanges::Vertex& change : changes.vertices) {
        if (at(change.slot) < old_count) {
            slots[at(change.slot)] = k_no_index; // unless it is found elsewhere
        }
    }
    for (const ClothChanges::Vertex& change : changes.vertices) {
        if (change.from != k_no_index) {
            slots[at(change.from)] = change.slot;
        }
    }
    return slots;
}

template <typename T>
void resize_range(std::vector<T>& values, std::size_t begin, std::size_t old, std::size_t now) {
    const auto end = values.begin() + static_cast<long>(begin + old);
    if (now < old) {
        values.erase(end - static_cast<long>(old - now), end);
    } else if (!values.empty()) {
        values.insert(end, now - old, T(values.front())); // values are set later
    }
}

} // namespace

void renumber_world(World& world,
                    std::size_t index,
                    std::size_t old_count,
                    const ClothChanges& changes) {
    const Cloth& cloth = world.cloths[index];
    const Index first = cloth.first_vertex;
    const Index old_end = first + static_cast<Index>(old_count);
    const Index shift = cloth.vertex_count - static_cast<Index>(old_count);
    const std::vector<Index> slots = slots_of_old(old_count, at(cloth.vertex_count), changes);
    const auto renumber = [&](Index v) { // obstacles' vertices come after all others
        if (v == k_no_index || v < first) {
            return v;
        }
        if (v >= old_end) {
            return v + shift;
        }
        const Index slot = slots[at(v - first)];
        return slot == k_no_index ? k_no_index : first + slot;
    };

    for (auto* values : {&world.positions, &world.velocities, &world.previous_positions,
                         &world.previous_velocities}) {
        resize_range(*values, at(first), old_count, at(cloth.vertex_count));
    }
    resize_range(world.masses, at(first), old_count, at(cloth.vertex_count));
    for (std::size_t c = index + 1; c < world.cloths.size(); ++c) {
        world.cloths[c].first_vertex += shift;
    }
    number_bodies(world);
    std::erase_if(world.pins,
                  [&](const Pin& pin) { return pin.vertex >= first && pin.vertex < old_end; });
    for (Pin& pin : world.pins) {
        pin.vertex = renumber(pin.vertex);
    }
    for (AttachedPair& pair : world.attached_pairs) {
        std::transform(pair.vertices.begin(), pair.vertices.end(), pair.vertices.begin(), renumber);
    }
    for (FrictionHistory& memory : world.friction_history) {
        std::transform(memory.pair.begin(), memory.pair.end(), memory.pair.begin(), renumber);
    }
    std::erase_if(world.friction_history, [](const FrictionHistory& memory) {
        return std::find(memory.pair.begin(), memory.pair.end(), k_no_index) != memory.pair.end();
    });
    std::sort(world.friction_history.begin(), world.friction_history.end(),
              [](const FrictionHistory& a, const FrictionHistory& b) { return a.pair < b.pair; });
}

} // namespace weft
