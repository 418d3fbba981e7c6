#include "forces/changed_slots.h"

#include <algorithm>

namespace weft {

namespace {

void sort_once(std::vector<Index>& slots) {
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
}

} // namespace

std::vector<Index> changed_hinges(const Cloth& cloth, const ClothChanges& changes) {
    std::vector<Index> slots = changes.edges;
    for (const Index t : changes.triangles) {
        const auto& edges = cloth.topology.triangle_edges[static_cast<std::size_t>(t)];
        slots.insert(slots.end(), edges.begin(), edges.end());
    }
    sort_once(slots);
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
    sort_once(slots);
    return slots;
}

} // namespace weft
