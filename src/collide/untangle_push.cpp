#include "collide/untangle_push.h"

#include "geometry/contour_gradient.h"
#include "geometry/crossing.h"
#include "geometry/separation.h"

namespace weft {

namespace {

bool share_vertex(const ContactSurface& surface, const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](Index v) { return surface.has_corner(t, v); });
}

void add_separation(const Tangle& tangle,
                    PairKind kind,
                    const std::array<Index, 4>& v,
                    double share,
                    std::vector<Push>& pushes) {
    const double room = share * tangle.surface.thickness_of(v, kind);
    const Separation s = separation(
        kind, {tangle.x[at(v[0])], tangle.x[at(v[1])], tangle.x[at(v[2])], tangle.x[at(v[3])]});
    if (s.distance < room && s.distance > 0.0) {
        pushes.push_back({v, s.weights, s.normal, room});
    }
}

/// Corners of `owner` that it speaks for, against the other triangle.
void add_vertex_faces(
    const Tangle& tangle, Index owner, Index other, double share, std::vector<Push>& pushes) {
    const Triangle& s = tangle.surface.triangles[at(owner)];
    const Triangle& t = tangle.surface.triangles[at(other)];
    for (std::size_t k = 0; k < 3; ++k) {
        if (tangle.surface.owns_corner(owner, k)) {
            add_separation(tangle, PairKind::VertexFace, {s[k], t[0], t[1], t[2]}, share, pushes);
        }
    }
}

void add_edge_edges(
    const Tangle& tangle, Index a, Index b, double share, std::vector<Push>& pushes) {
    const Triangle& s = tangle.surface.triangles[at(a)];
    const Triangle& t = tangle.surface.triangles[at(b)];
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (tangle.surface.owns_side(a, k) && tangle.surface.owns_side(b, j)) {
                add_separation(tangle, PairKind::EdgeEdge,
                               {s[(k + 1) % 3], s[(k + 2) % 3], t[(j + 1) % 3], t[(j + 2) % 3]},
                               share, pushes);
            }
        }
    }
}

/// The side of `s` opposite to corner k, if it pierces t: moved against t along the gradient of the
/// contour.
void add_contour_push(
    const Tangle& tangle, Index s, std::size_t k, Index t, double step, std::vector<Push>& pushes) {
    const Triangle& edge_of = tangle.surface.triangles[at(s)];
    const Triangle& face = tangle.surface.triangles[at(t)];
    const Index p = edge_of[(k + 1) % 3];
    const Index q = edge_of[(k + 2) % 3];
    const auto f = tangle.corners(t);
    const Vec3& xp = tangle.x[at(p)];
    const Vec3& xq = tangle.x[at(q)];
    const bool shares = share_vertex(tangle.surface, {p, q, p}, face);
    if (!tangle.surface.owns_side(s, k) || shares ||
        !segment_meets_triangle(xp, xq, f[0], f[1], f[2])) {
        return;
    }
    std::vector<Vec3> apexes{tangle.x[at(edge_of[k])]};
    if (const Index across = tangle.surface.across[at(s)][k]; across != k_no_index) {
        apexes.push_back(tangle.x[at(across)]);
    }
    const auto normal = triangle_normal(f[0], f[1], f[2]);
    const auto gradient = contour_gradient(xp, xq, apexes, normal);
    if (!gradient) {
        return;
    }
    const Vec3 moved = 0.5 * (xp + xq);
    const Vec3 centre = (f[0] + f[1] + f[2]) / 3.0;
    pushes.push_back({{p, q, k_no_index, k_no_index},
                      {0.5, 0.5, 0.0, 0.0},
                      *gradient,
                      gradient->dot(moved) + step});
    pushes.push_back({{face[0], face[1], face[2], k_no_index},
                      {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0, 0.0},
                      -*gradient,
                      -gradient->dot(centre) + step});
}

} // namespace

void apply(const Push& push, double greatest, Tangle& tangle) {
    double value = -push.least;
    double share = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (push.vertices[k] != k_no_index) {
            const std::size_t v = at(push.vertices[k]);
            value += push.weights[k] * push.normal.dot(tangle.x[v]);
            share += push.weights[k] * push.weights[k] * tangle.mobility[v];
        }
    }
    if (value >= 0.0 || share <= 0.0) {
        return;
    }
    const double length = std::min(-value, greatest) / share;
    for (std::size_t k = 0; k < 4; ++k) {
        if (push.vertices[k] != k_no_index) {
            const std::size_t v = at(push.vertices[k]);
            const double way =
                std::clamp(length * push.weights[k] * tangle.mobility[v], -greatest, greatest);
            tangle.x[v] += way * push.normal;
        }
    }
}

void find_room_pushes(const Tangle& tangle,
                      std::span<const NearPair> pairs,
                      double room,
                      std::vector<Push>& pushes) {
    for (const NearPair& pair : pairs) {
        const bool neighbours =
            share_vertex(tangle.surface, tangle.surface.triangles[at(pair.first)],
                         tangle.surface.triangles[at(pair.second)]);
        if (!pair.crosses && !neighbours) {
            add_vertex_faces(tangle, pair.first, pair.second, room, pushes);
            add_vertex_faces(tangle, pair.second, pair.first, room, pushes);
            add_edge_edges(tangle, pair.first, pair.second, room, pushes);
        }
    }
}

void find_contour_pushes(const Tangle& tangle,
                         std::span<const NearPair> pairs,
                         double step,
                         std::vector<Push>& pushes) {
    for (const NearPair& pair : pairs) {
        if (!pair.crosses || tangle.stands(pair.second)) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            add_contour_push(tangle, pair.first, k, pair.second, step, pushes);
            add_contour_push(tangle, pair.second, k, pair.first, step, pushes);
        }
    }
}

} // namespace weft
