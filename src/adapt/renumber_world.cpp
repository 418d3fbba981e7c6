#include "adapt/renumber_world.h"

#include "state/body.h"

#include <algorithm>
#include <numeric>

namespace weft {

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
