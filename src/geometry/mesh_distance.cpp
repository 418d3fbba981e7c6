#include "geometry/mesh_distance.h"

#include <cassert>
#include <limits>
#include <queue>

namespace weft {

namespace {

/// Neighbours of all vertices, those of v at [first[v], first[v + 1]); some stand twice.
struct Neighbours {
    std::vector<std::size_t> first;
    std::vector<Index> vertex;
};

Neighbours find_neighbours(std::size_t vertices, std::span<const Triangle> triangles) {
    Neighbours n;
    n.first.assign(vertices + 1, 0);
    for (const Triangle& t : triangles) {
        for (const Index v : t) {
            n.first[at(v) + 1] += 2;
        }
    }
    for (std::size_t v = 0; v < vertices; ++v) {
        n.first[v + 1] += n.first[v];
    }
    n.vertex.resize(n.first.back());
    std::vector<std::size_t> next = n.first;
    for (const Triangle& t : triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            std::size_t& slot = next[at(t[k])];
            n.vertex[slot++] = t[(k + 1) % 3];
            n.vertex[slot++] = t[(k + 2) % 3];
        }
    }
    return n;
}

} // namespace

MeshDistances mesh_distances(std::span<const Vec3> positions,
                             std::span<const Triangle> triangles,
                             std::span<const double> start) {
    assert(start.size() == positions.size());
    const Neighbours neighbours = find_neighbours(positions.size(), triangles);
    MeshDistances result{{start.begin(), start.end()},
                         std::vector<Index>(positions.size(), k_no_index)};
    using Entry = std::pair<double, Index>; // equal costs: the lower vertex first, so no chance
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::size_t v = 0; v < start.size(); ++v) {
        if (start[v] < std::numeric_limits<double>::infinity()) {
            result.source[v] = static_cast<Index>(v);
            open.emplace(start[v], static_cast<Index>(v));
        }
    }
    while (!open.empty()) {
        const auto [cost, vertex] = open.top();
        open.pop();
        const auto v = at(vertex);
        if (cost > result.cost[v]) {
            continue; // a cheaper way was found meanwhile
        }
        for (std::size_t i = neighbours.first[v]; i < neighbours.first[v + 1]; ++i) {
            const auto w = at(neighbours.vertex[i]);
            const double to_w = cost + (positions[w] - positions[v]).norm();
            if (to_w < result.cost[w]) {
                result.cost[w] = to_w;
                result.source[w] = result.source[v];
                open.emplace(to_w, neighbours.vertex[i]);
            }
        }
    }
    return result;
}

} // namespace weft
