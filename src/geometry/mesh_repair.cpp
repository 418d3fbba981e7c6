#include "geometry/mesh_repair.h"

#include "geometry/winding_number.h"

#include <algorithm>
#include <cmath>
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
    side[at(first)] = 1;
    part.triangles.push_back(first);
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        const Index t = part.triangles[i];
        auto n = std::lower_bound(neighbours.begin(), neighbours.end(), t,
                                  [](const Neighbour& a, Index b) { return a.triangle < b; });
        for (; n != neighbours.end() && n->triangle == t; ++n) {
            const auto mine = side[at(t)];
            const auto wanted = static_cast<signed char>(n->runs_same_way ? -mine : mine);
            auto& other = side[at(n->other)];
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
            if (side[at(member)] == flip_side) {
                report.flipped.push_back(member);
            }
        }
    }
    std::sort(report.flipped.begin(), report.flipped.end());
    for (const Index t : report.flipped) {
        std::swap(triangles[at(t)][1], triangles[at(t)][2]);
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
        const auto x = [&](std::size_t k) -> Vec3 { return positions[at(t[k])] - origin; };
        volume += x(0).dot(x(1).cross(x(2))) / 6.0;
    }
    return volume;
}

namespace {

/// One connected part of a closed mesh.
struct ClosedPart {
    TriangleMesh mesh;   ///< triangles of the part, positions of the whole mesh
    double volume = 0.0; ///< m^3, negative when wound inward
};

std::vector<ClosedPart>
take_apart(const TriangleMesh& mesh, const std::vector<int>& part_of, int count) {
    std::vector<ClosedPart> parts(at(count));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        ClosedPart& part = parts[at(part_of[t])];
        part.mesh.triangles.push_back(mesh.triangles[t]);
        const auto x = [&](std::size_t k) { return mesh.positions[at(mesh.triangles[t][k])]; };
        part.volume += x(0).dot(x(1).cross(x(2))) / 6.0;
    }
    for (ClosedPart& part : parts) {
        part.mesh.positions = mesh.positions;
    }
    return parts;
}

} // namespace

void orient_parts(TriangleMesh& mesh) {
    std::vector<int> part_of;
    const int count = connected_parts(mesh.triangles, part_of);
    const std::vector<ClosedPart> parts = take_apart(mesh, part_of, count);
    std::vector<WindingNumber> windings;
    for (const ClosedPart& part : parts) {
        windings.emplace_back(part.mesh);
    }
    std::vector<char> turn(parts.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const Triangle& first = parts[p].mesh.triangles[0];
        int around = 0;
        for (std::size_t other = 0; other < parts.size(); ++other) {
            const Vec3& x = mesh.positions[at(first[0])];
            around += other != p && std::abs(windings[other].around(x)) > 0.5 ? 1 : 0;
        }
        const bool wants_outward = around % 2 == 0;
        turn[p] = (parts[p].volume > 0.0) == wants_outward ? 0 : 1;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (turn[at(part_of[t])] != 0) {
            std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
        }
    }
}

namespace {

/// Vertices in the middle of edges, by edge; k_no_index: it stays whole.
std::vector<Index> halve(TriangleMesh& mesh, const EdgeTopology& topology, double longest) {
    std::vector<Index> middles(topology.edges.size(), k_no_index);
    for (std::size_t e = 0; e < middles.size(); ++e) {
        const Vec3& a = mesh.positions[at(topology.edges[e].v[0])];
        const Vec3& b = mesh.positions[at(topology.edges[e].v[1])];
        if ((a - b).norm() > longest) {
            middles[e] = static_cast<Index>(mesh.positions.size());
            mesh.positions.emplace_back(0.5 * (a + b));
        }
    }
    return middles;
}

/// The triangles that a triangle becomes.
class Pieces {
public:
    Pieces(const TriangleMesh& mesh, std::vector<Triangle>& out) : mesh_(mesh), out_(out) {}

    /// @param middle  on the edge opposite to each corner, or k_no_index
    void add(const Triangle& t, const std::array<Index, 3>& middle) {
        const int halved = (middle[0] >= 0) + (middle[1] >= 0) + (middle[2] >= 0);
        if (halved == 0) {
            out_.push_back(t);
        } else if (halved == 3) {
            out_.push_back(middle);
            for (std::size_t k = 0; k < 3; ++k) {
                out_.push_back({t[k], middle[(k + 2) % 3], middle[(k + 1) % 3]});
            }
        } else {
            std::size_t k = 0; // halved == 1: the edge opposite to k is halved; 2: is whole
            while ((middle[k] >= 0) != (halved == 1)) {
                ++k;
            }
            halved == 1 ? in_two(t, middle, k) : in_three(t, middle, k);
        }
    }

private:
    void in_two(const Triangle& t, const std::array<Index, 3>& middle, std::size_t k) {
        out_.push_back({t[k], t[(k + 1) % 3], middle[k]});
        out_.push_back({t[k], middle[k], t[(k + 2) % 3]});
    }

    /// Corner k is cut off; of the rest's diagonals the shorter one is taken.
    void in_three(const Triangle& t, const std::array<Index, 3>& middle, std::size_t k) {
        const Index b = t[(k + 1) % 3];
        const Index c = t[(k + 2) % 3];
        const Index on_c = middle[(k + 1) % 3]; // between k and c
        const Index on_b = middle[(k + 2) % 3]; // between k and b
        out_.push_back({t[k], on_b, on_c});
        if (length(b, on_c) <= length(c, on_b)) {
            out_.push_back({b, c, on_c});
            out_.push_back({b, on_c, on_b});
        } else {
            out_.push_back({b, c, on_b});
            out_.push_back({c, on_c, on_b});
        }
    }

    double length(Index a, Index b) const {
        return (mesh_.positions[at(a)] - mesh_.positions[at(b)]).norm();
    }

    const TriangleMesh& mesh_;
    std::vector<Triangle>& out_;
};

} // namespace

TriangleMesh split_long_edges(TriangleMesh mesh, double longest) {
    while (true) {
        const EdgeTopology topology = build_edges(mesh.triangles);
        const std::size_t before = mesh.positions.size();
        const std::vector<Index> middles = halve(mesh, topology, longest);
        if (mesh.positions.size() == before) {
            return mesh;
        }
        std::vector<Triangle> triangles;
        Pieces pieces(mesh, triangles);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& edges = topology.triangle_edges[t];
            pieces.add(mesh.triangles[t],
                       {middles[at(edges[0])], middles[at(edges[1])], middles[at(edges[2])]});
        }
        mesh.triangles = std::move(triangles);
    }
}

} // namespace weft
