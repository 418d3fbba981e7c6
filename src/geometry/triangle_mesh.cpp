#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace weft {

namespace {

/// One side of one triangle, with its ends in ascending order.
struct HalfEdge {
    Index low, high;
    Index triangle;
    int corner; ///< the corner opposite to it
    bool reversed;
};

std::vector<HalfEdge> sorted_half_edges(std::span<const Triangle> triangles) {
    std::vector<HalfEdge> halves;
    halves.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles[t][at((k + 1) % 3)];
            const Index b = triangles[t][at((k + 2) % 3)];
            halves.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), k, a > b});
        }
    }
    std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.triangle, a.corner) <
               std::tie(b.low, b.high, b.triangle, b.corner);
    });
    return halves;
}

} // namespace

EdgeTopology build_edges(std::span<const Triangle> triangles) {
    const std::vector<HalfEdge> halves = sorted_half_edges(triangles);
    const auto apex_of = [&](const HalfEdge& h) { return triangles[at(h.triangle)][at(h.corner)]; };
    std::vector<std::pair<MeshEdge, std::array<int, 2>>> found; // the edge and its two corners
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const HalfEdge& h = halves[i];
        MeshEdge edge{{h.low, h.high}, {h.triangle, k_no_index}, {apex_of(h), k_no_index}};
        if (h.reversed) {
            std::swap(edge.v[0], edge.v[1]);
        }
        std::array<int, 2> corners{h.corner, -1};
        const bool paired = i + 1 < halves.size() && halves[i + 1].low == h.low &&
                            halves[i + 1].high == h.high && halves[i + 1].reversed != h.reversed;
        if (paired) {
            const HalfEdge& other = halves[++i];
            edge.triangle[1] = other.triangle;
            edge.apex[1] = apex_of(other);
            corners[1] = other.corner;
        }
        found.emplace_back(edge, corners);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first.triangle[0], a.second[0]) <
               std::tie(b.first.triangle[0], b.second[0]);
    });

    EdgeTopology topology;
    topology.triangle_edges.assign(triangles.size(), {k_no_index, k_no_index, k_no_index});
    for (const auto& [edge, corners] : found) {
        const auto index = static_cast<Index>(topology.edges.size());
        topology.edges.push_back(edge);
        for (std::size_t side = 0; side < 2; ++side) {
            if (edge.triangle[side] != k_no_index) {
                topology.triangle_edges[at(edge.triangle[side])][at(corners[side])] = index;
            }
        }
    }
    return topology;
}

std::vector<std::vector<Index>> boundary_loops(const EdgeTopology& topology) {
    std::vector<std::pair<Index, Index>> next; // boundary edges by their first vertex
    for (const MeshEdge& edge : topology.edges) {
        if (edge.is_boundary()) {
            next.emplace_back(edge.v[0], edge.v[1]);
        }
    }
    std::sort(next.begin(), next.end());
    std::vector<char> used(next.size(), 0);
    std::vector<std::vector<Index>> loops;
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (used[start]) {
            continue;
        }
        std::vector<Index> loop;
        std::size_t current = start;
        while (true) {
            used[current] = 1;
            loop.push_back(next[current].first);
            auto step = std::lower_bound(next.begin(), next.end(),
                                         std::pair<Index, Index>{next[current].second, k_no_index});
            while (step != next.end() && step->first == next[current].second &&
                   used[static_cast<std::size_t>(step - next.begin())]) {
                ++step; // a vertex where two loops touch has several ways on
            }
            if (step == next.end() || step->first != next[current].second) {
                break;
            }
            current = static_cast<std::size_t>(step - next.begin());
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

int connected_parts(std::span<const Triangle> triangles, std::vector<int>& part_of_triangle) {
    Index vertex_count = 0;
    for (const Triangle& t : triangles) {
        vertex_count = std::max({vertex_count, t[0] + 1, t[1] + 1, t[2] + 1});
    }
    std::vector<Index> root(at(vertex_count));
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](Index v) {
        while (root[at(v)] != v) {
            auto& parent = root[at(v)];
            parent = root[at(parent)];
            v = parent;
        }
        return v;
    };
    for (const Triangle& t : triangles) {
        for (int k = 1; k < 3; ++k) {
            const Index a = find(t[0]);
            const Index b = find(t[at(k)]);
            root[at(std::max(a, b))] = std::min(a, b);
        }
    }
    std::vector<int> part_of_root(root.size(), -1);
    part_of_triangle.assign(triangles.size(), -1);
    int parts = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        int& part = part_of_root[at(find(triangles[t][0]))];
        if (part < 0) {
            part = parts++;
        }
        part_of_triangle[t] = part;
    }
    return parts;
}

Vec3 triangle_normal(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    const Vec3 n = (x1 - x0).cross(x2 - x0);
    const double length = n.norm();
    return length > 0.0 ? Vec3(n / length) : Vec3::Zero();
}

double triangle_area(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    return 0.5 * (x1 - x0).cross(x2 - x0).norm();
}

} // namespace weft
