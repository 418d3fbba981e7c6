#include "geometry/mesh_repair.h"

#include <algorithm>
#include <tuple>

namespace weft {

namespace {

/// Two triangles across an edge that only they have.
struct Neighbour {
    Index triangle, other;
    bool runs_same_way; ///< along the edge: one of them must be flipped
};

std::vector<Neighbour> find_neighbours(std::span<const Triangle> triangles) {
    struct Side {
        Index low, high, triangle;
        bool reversed;
    };
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = triangles[t][k];
            const Index b = triangles[t][(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(t), a > b});
        }
    }
    const auto edge = [](const Side& s) { return std::tie(s.low, s.high); };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    std::vector<Neighbour> neighbours;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && edge(sides[end]) == edge(sides[i])) {
            ++end;
        }
        if (end - i == 2 && sides[i].triangle != sides[i + 1].triangle) {
            const bool same = sides[i].reversed == sides[i + 1].reversed;
            neighbours.push_back({sides[i].triangle, sides[i + 1].triangle, same});
            neighbours.push_back({sides[i + 1].triangle, sides[i].triangle, same});
        }
        i = end;
    }
    std::sort(neighbours.begin(), neighbours.end(), [](const Neighbour& a, const Neighbour& b) {
        return std::tie(a.triangle, a.other) < std::tie(b.triangle, b.other);
    });
    return neighbours;
}

/// One connected part: its triangles and whether each must be flipped to agree with the first.
struct Part {
    std::vector<Index> triangles;
    std::size_t to_flip = 0;
    bool is_orientable = true;
};

/// Walks the part of triangle `first`; side[t] becomes +1 (as the first) or -1, 0 is unvisited.
Part walk_part(Index first, std::span<const Neighbour> neighbours, std::vector<signed char>& side) {
    Part part;
    side[static_cast<std::size_t>(first)] = 1;
    part.triangles.push_back(first);
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        const Index t = part.triangles[i];
        auto n = std::lower_bound(neighbours.begin(), neighbours.end(), t,
                                  [](const Neighbour& a, Index b) { return a.triangle < b; });
        for (; n != neighbours.end() && n->triangle == t; ++n) {
            const auto mine = side[static_cast<std::size_t>(t)];
            const auto wanted = static_cast<signed char>(n->runs_same_way ? -mine : mine);
            auto& other = side[static_cast<std::size_t>(n->other)];
            if (other == 0) {
                other = wanted;
                part.triangles.push_back(n->other);
                part.to_flip += wanted < 0 ? 1 : 0;
            } else if (other != wanted) {
                part.is_orientable = false;
            }
        }
    }
    return part;
}

} // namespace

OrientReport orient_consistently(std::vector<Triangle>& triangles) {
    const std::vector<Neighbour> neighbours = find_neighbours(triangles);
    std::vector<signed char> side(triangles.size(), 0);
    OrientReport report;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (side[t] != 0) {
            continue;
        }
        const Part part = walk_part(static_cast<Index>(t), neighbours, side);
        if (!part.is_orientable) {
            report.is_orientable = false;
            continue;
        }
        const signed char flip_side = 2 * part.to_flip > part.triangles.size() ? 1 : -1;
        for (const Index member : part.triangles) {
            if (side[static_cast<std::size_t>(member)] == flip_side) {
                report.flipped.push_back(member);
            }
        }
    }
    std::sort(report.flipped.begin(), report.flipped.end());
    for (const Index t : report.flipped) {
        std::swap(triangles[static_cast<std::size_t>(t)][1],
                  triangles[static_cast<std::size_t>(t)][2]);
    }
    return report;
}

double enclosed_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    if (positions.empty()) {
        return 0.0;
    }
    const Vec3 origin = positions[0]; // near the mesh: far away the cones would cancel badly
    double volume = 0.0;
    for (const Triangle& t : triangles) {
        const auto x = [&](std::size_t k) -> Vec3 {
            return positions[static_cast<std::size_t>(t[k])] - origin;
        };
        volume += x(0).dot(x(1).cross(x(2))) / 6.0;
    }
    return volume;
}

} // namespace weft
