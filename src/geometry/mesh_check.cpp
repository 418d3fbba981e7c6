#include "geometry/mesh_check.h"

#include "geometry/weld.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace weft {

namespace {

bool in_range(const Triangle& t, std::size_t vertices) {
    return std::all_of(t.begin(), t.end(), [&](Index v) { return v >= 0 && at(v) < vertices; });
}

bool has_equal_corners(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void find_bad_vertices(std::span<const Vec3> positions,
                       std::span<const Triangle> triangles,
                       MeshDefects& defects) {
    std::vector<char> used(positions.size(), 0);
    for (const Triangle& t : triangles) {
        for (const Index v : t) {
            if (v >= 0 && at(v) < positions.size()) {
                used[at(v)] = 1;
            }
        }
    }
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (!positions[v].allFinite()) {
            defects.not_finite.push_back(static_cast<Index>(v));
        }
        if (!used[v]) {
            defects.unused_vertices.push_back(static_cast<Index>(v));
        }
    }
}

void find_bad_triangles(std::span<const Vec3> positions,
                        std::span<const Triangle> triangles,
                        MeshDefects& defects) {
    const double least = k_least_altitude_fraction * bounding_diagonal(positions);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        const auto x = [&](int k) -> const Vec3& { return positions[at(t[at(k)])]; };
        if (!in_range(t, positions.size())) {
            defects.out_of_range.push_back(static_cast<Index>(i));
        } else if (has_equal_corners(t) || least_altitude(x(0), x(1), x(2)) <= least) {
            defects.degenerate.push_back(static_cast<Index>(i));
        }
    }
}

void find_duplicates(std::span<const Triangle> triangles, MeshDefects& defects) {
    std::vector<std::pair<Triangle, Index>> sorted;
    sorted.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        Triangle t = triangles[i];
        std::sort(t.begin(), t.end());
        sorted.emplace_back(t, static_cast<Index>(i));
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (sorted[i].first == sorted[i - 1].first && !has_equal_corners(sorted[i].first)) {
            defects.duplicates.push_back(sorted[i].second);
        }
    }
    std::sort(defects.duplicates.begin(), defects.duplicates.end());
}

/// A side of a triangle, its ends in ascending order.
struct Side {
    Index low, high;
    bool reversed;
};

void find_bad_edges(std::span<const Triangle> triangles, MeshDefects& defects) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.size());
    for (const Triangle& t : triangles) {
        if (has_equal_corners(t)) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k];
            const Index b = t[(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), a > b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.reversed) < std::tie(b.low, b.high, b.reversed);
    });
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high) {
            ++end;
        }
        if (end - i > 2) {
            defects.non_manifold_edges.push_back({sides[i].low, sides[i].high});
        } else if (end - i == 2 && sides[i].reversed == sides[i + 1].reversed) {
            defects.winding_edges.push_back({sides[i].low, sides[i].high});
        }
        i = end;
    }
}

/// A vertex is pinched when the triangles around it, joined across its edges, make several fans.
void find_pinched_vertices(std::span<const Triangle> triangles, MeshDefects& defects) {
    struct Spoke {
        Index hub, rim;
        std::size_t corner;
    };
    std::vector<Spoke> spokes; // each triangle corner's two edges
    spokes.reserve(6 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (has_equal_corners(triangles[t])) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            spokes.push_back({triangles[t][k], triangles[t][(k + 1) % 3], 3 * t + k});
            spokes.push_back({triangles[t][k], triangles[t][(k + 2) % 3], 3 * t + k});
        }
    }
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
        return std::tie(a.hub, a.rim, a.corner) < std::tie(b.hub, b.rim, b.corner);
    });
    std::vector<std::size_t> root(3 * triangles.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&](std::size_t c) {
        while (root[c] != c) {
            root[c] = root[root[c]];
            c = root[c];
        }
        return c;
    };
    for (std::size_t i = 1; i < spokes.size(); ++i) {
        if (spokes[i].hub == spokes[i - 1].hub && spokes[i].rim == spokes[i - 1].rim) {
            const std::size_t a = find(spokes[i].corner);
            const std::size_t b = find(spokes[i - 1].corner);
            root[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::size_t i = 1; i < spokes.size(); ++i) {
        const bool same_hub = spokes[i].hub == spokes[i - 1].hub;
        if (same_hub && find(spokes[i].corner) != find(spokes[i - 1].corner) &&
            (defects.pinched_vertices.empty() ||
             defects.pinched_vertices.back() != spokes[i].hub)) {
            defects.pinched_vertices.push_back(spokes[i].hub);
        }
    }
}

/// At most this many element numbers in a message: one line stays readable.
constexpr std::size_t k_named = 5;

template <typename Elements, typename Name> std::string list_few(Elements all, Name name) {
    std::string text;
    for (std::size_t i = 0; i < std::min(all.size(), k_named); ++i) {
        text += (i == 0 ? "" : ", ") + name(all[i]);
    }
    if (all.size() > k_named) {
        text += fmt::format(" and {} more", all.size() - k_named);
    }
    return text;
}

} // namespace

double least_altitude(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    const double longest = std::sqrt(
        std::max({(x1 - x0).squaredNorm(), (x2 - x1).squaredNorm(), (x0 - x2).squaredNorm()}));
    return longest > 0.0 ? 2.0 * triangle_area(x0, x1, x2) / longest : 0.0;
}

MeshDefects find_defects(std::span<const Vec3> positions, std::span<const Triangle> triangles) {
    MeshDefects defects;
    find_bad_vertices(positions, triangles, defects);
    find_bad_triangles(positions, triangles, defects);
    find_duplicates(triangles, defects);
    find_bad_edges(triangles, defects);
    find_pinched_vertices(triangles, defects);
    return defects;
}

MeshDefects find_defects(const TriangleMesh& mesh) {
    return find_defects(mesh.positions, mesh.triangles);
}

std::string first_few(std::span<const Index> numbers) {
    return list_few(numbers, [](Index i) { return fmt::format("{}", i); });
}

std::string first_few(std::span<const std::array<Index, 2>> edges) {
    return list_few(edges, [](const auto& e) { return fmt::format("{}-{}", e[0], e[1]); });
}

} // namespace weft
