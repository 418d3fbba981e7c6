#include "forces/changed_slots.h"

#include <algorithm>

namespace weft {

namespace {

/// Sorts slots below `count`, each once. Many of them are ticked off and gathered, which is faster.
void sort_once(std::vector<Index>& slots, std::size_t count) {
    constexpr std::size_t k_many = 64; // one in so many
    if (slots.size() < count / k_many) {
        std::sort(slots.begin(), slots.end());
        slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
        return;
    }
    std::vector<char> is_in(count, 0);
    for (const Index slot : slots) {
        is_in[static_cast<std::size_t>(slot)] = 1;
    }
    slots.clear();
    for (std::size_t slot = 0; slot < count; ++slot) {
        if (is_in[slot] != 0) {
            slots.push_back(static_cast<Index>(slot));
        }
    }
}

} // namespace

std::vector<Index> changed_hinges(const Cloth& cloth, const ClothChanges& changes) {
    std::vector<Index> slots = changes.edges;
    for (const Index t : changes.triangles) {
        const auto& edges = cloth.topology.triangle_edges[static_cast<std::size_t>(t)];
        slots.insert(slots.end(), edges.begin(), edges.end());
    }
    sort_once(slots, cloth.topology.edges.size());
    return slots;
}

std::vector<Index> changed_patches(const Cloth& cloth, const ClothChanges& changes) {
    // A triangle and its neighbours are all those at its edges.
    std::vector<Index> slots = changes.triangles;
    for (const Index e : changed_hinges(cloth, changes)) {
        for (const Index t : cloth.topology.edges[static_cast<std::size_t>(e)].triangle) {
            if (t != k_no_index) {
                slots.push_back(t);
            }
        }
    }
    sort_once(slots, cloth.triangles.size());
    return slots;
}

} // namespace weft
