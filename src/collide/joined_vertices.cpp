#include "collide/contact_surface.h"

#include <algorithm>

namespace weft {

namespace {

/// Calls f(v, w) for each two vertices on the two sides of a joined pair, both ways round.
template <typename F> void for_each_joined(const World& world, const F& f) {
    for (std::size_t i = 0; i < world.attached_pairs.size(); ++i) {
        if (world.attached_states[i].is_joined == 0) {
            continue;
        }
        const AttachedPair& pair = world.attached_pairs[i];
        for (std::size_t a = 0; a < 6; ++a) {
            for (std::size_t b = 0; b < 6; ++b) {
                if (pair.weights[a] * pair.weights[b] < 0.0) {
                    f(pair.vertices[a], pair.vertices[b]);
                }
            }
        }
    }
}

} // namespace

bool ContactSurface::are_joined(Index a, Index b) const {
    return std::binary_search(joined.begin() + joined_begin[at(a)],
                              joined.begin() + joined_begin[at(a) + 1], b);
}

void join_seams(ContactSurface& surface, const World& world) {
    surface.joined_begin.clear();
    surface.joined.clear();
    std::size_t links = 0;
    for_each_joined(world, [&](Index, Index) { ++links; });
    if (links == 0) {
        return;
    }
    surface.joined_begin.assign(surface.start.size() + 1, 0);
    for_each_joined(world, [&](Index v, Index) { ++surface.joined_begin[at(v) + 1]; });
    for (std::size_t v = 0; v < surface.start.size(); ++v) {
        surface.joined_begin[v + 1] += surface.joined_begin[v];
    }
    surface.joined.resize(links);
    // each list is filled through the entry of its end, which starts where the list begins
    for (std::size_t v = surface.start.size(); v > 0; --v) {
        surface.joined_begin[v] = surface.joined_begin[v - 1];
    }
    for_each_joined(world, [&](Index v, Index w) {
        surface.joined[at(surface.joined_begin[at(v) + 1]++)] = w;
    });
    for (std::size_t v = 0; v < surface.start.size(); ++v) {
        const auto begin = surface.joined.begin() + surface.joined_begin[v];
        std::sort(begin, surface.joined.begin() + surface.joined_begin[v + 1]);
    }
}

} // namespace weft
