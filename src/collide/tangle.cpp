#include "collide/tangle.h"

#include "base/parallel.h"
#include "collide/crossings.h"
#include "geometry/crossing.h"
#include "geometry/distance.h"

#include <algorithm>
#include <tuple>

namespace weft {

namespace {

constexpr std::size_t k_tasks = 128;

std::vector<Index> triangles_with(const Tangle& tangle, TangleRole role) {
    std::vector<Index> triangles;
    for (std::size_t o = 0; o < tangle.roles.size(); ++o) {
        const ContactObject& object = tangle.surface.objects[o];
        for (Index t = 0; tangle.roles[o] == role && t < object.triangle_count; ++t) {
            triangles.push_back(object.first_triangle + t);
        }
    }
    return triangles;
}

void fit(const Tangle& tangle,
         std::span<const Index> triangles,
         double margin,
         std::vector<Box>& boxes,
         BoxTree& tree) {
    boxes.resize(triangles.size());
    parallel_for(triangles.size(), [&](std::size_t i) {
        const auto c = tangle.corners(triangles[i]);
        boxes[i] = unite(segment_box(c[0], c[1], margin), segment_box(c[2], c[2], margin));
    });
    if (tree.empty()) {
        tree = BoxTree(std::span<const Box>(boxes));
    } else {
        tree.refit(boxes);
    }
}

bool share_vertex(const ContactSurface& surface, const Triangle& s, const Triangle& t) {
    return std::any_of(s.begin(), s.end(), [&](Index v) { return surface.has_corner(t, v); });
}

void add_separation(const Tangle& tangle,
                    PairKind kind,
                    const std::array<Index, 4>& v,
                    double clearance,
                    std::vector<Push>& pushes) {
    const double gap = clearance * tangle.surface.thickness_of(v, kind);
    const Separation s = separation(
        kind, {tangle.x[at(v[0])], tangle.x[at(v[1])], tangle.x[at(v[2])], tangle.x[at(v[3])]});
    if (s.distance < gap && s.distance > 0.0) {
        pushes.push_back({v, s.weights, s.normal, gap});
    }
}

/// Corners of `owner` that it speaks for, against the other triangle.
void add_vertex_faces(
    const Tangle& tangle, Index owner, Index other, double clearance, std::vector<Push>& pushes) {
    const Triangle& s = tangle.surface.triangles[at(owner)];
    const Triangle& t = tangle.surface.triangles[at(other)];
    for (std::size_t k = 0; k < 3; ++k) {
        if (tangle.surface.owns_corner(owner, k)) {
            add_separation(tangle, PairKind::VertexFace, {s[k], t[0], t[1], t[2]}, clearance,
                           pushes);
        }
    }
}

void add_edge_edges(
    const Tangle& tangle, Index a, Index b, double clearance, std::vector<Push>& pushes) {
    const Triangle& s = tangle.surface.triangles[at(a)];
    const Triangle& t = tangle.surface.triangles[at(b)];
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < 3; ++j) {
            if (tangle.surface.owns_side(a, k) && tangle.surface.owns_side(b, j)) {
                add_separation(tangle, PairKind::EdgeEdge,
                               {s[(k + 1) % 3], s[(k + 2) % 3], t[(j + 1) % 3], t[(j + 2) % 3]},
                               clearance, pushes);
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
    if (const Index apex = tangle.surface.opposite[at(s)][k]; apex != k_no_index) {
        apexes.push_back(tangle.x[at(apex)]);
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

Tangle make_tangle(const World& world) {
    Tangle tangle;
    tangle.surface = make_surface(world);
    tangle.roles.assign(tangle.surface.objects.size(), TangleRole::Stands);
    tangle.mobility.assign(tangle.surface.start.size(), 0.0);
    tangle.x = world.positions;
    tangle.x.resize(tangle.surface.start.size());
    std::size_t next = world.vertex_count();
    for (const Obstacle& obstacle : world.obstacles) {
        const std::size_t count = obstacle.mesh.positions.size();
        obstacle_positions(obstacle, world.time, std::span(tangle.x).subspan(next, count));
        next += count;
    }
    return tangle;
}

void set_role(Tangle& tangle, std::size_t object, TangleRole role) {
    tangle.roles[object] = role;
    const ContactObject& o = tangle.surface.objects[object];
    std::fill_n(tangle.mobility.begin() + o.first_vertex, o.vertex_count,
                role == TangleRole::Moves ? 1.0 : 0.0);
}

NearPairSearch::NearPairSearch(const Tangle& tangle, bool self)
    : self_(self), moving_(triangles_with(tangle, TangleRole::Moves)),
      standing_(triangles_with(tangle, TangleRole::Stands)) {}

void NearPairSearch::find(const Tangle& tangle, double margin, std::vector<NearPair>& pairs) {
    pairs.clear();
    fit(tangle, moving_, 0.5 * margin, boxes_, moving_tree_);
    if (standing_margin_ != margin) {
        fit(tangle, standing_, 0.5 * margin, boxes_, standing_tree_);
        standing_margin_ = margin;
    }
    if (self_) {
        gather(tangle, moving_tree_, moving_tree_, moving_, pairs);
    }
    gather(tangle, moving_tree_, standing_tree_, standing_, pairs);
    std::sort(pairs.begin(), pairs.end(), [](const NearPair& a, const NearPair& b) {
        return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
}

void NearPairSearch::gather(const Tangle& tangle,
                            const BoxTree& a,
                            const BoxTree& b,
                            std::span<const Index> of_b,
                            std::vector<NearPair>& pairs) {
    if (a.empty() || b.empty()) {
        return;
    }
    BoxTree::split(a, b, k_tasks, tasks_);
    parallel_collect(
        tasks_.size(),
        [&](std::size_t i, std::vector<NearPair>& found) {
            BoxTree::overlaps(a, b, tasks_[i], [&](Index s, Index t) {
                const Index first = moving_[at(s)];
                const Index second = of_b[at(t)];
                found.push_back(
                    {first, second, triangles_cross(tangle.surface, first, second, tangle.x)});
            });
        },
        tasks_found_, pairs, 1);
}

void apply(const Push& push, double limit, Tangle& tangle) {
    double value = -push.least;
    double compliance = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (push.vertices[k] != k_no_index) {
            const std::size_t v = at(push.vertices[k]);
            value += push.weights[k] * push.normal.dot(tangle.x[v]);
            compliance += push.weights[k] * push.weights[k] * tangle.mobility[v];
        }
    }
    if (value >= 0.0 || compliance <= 0.0) {
        return;
    }
    const double length = std::min(-value, limit) / compliance;
    for (std::size_t k = 0; k < 4; ++k) {
        if (push.vertices[k] != k_no_index) {
            const std::size_t v = at(push.vertices[k]);
            const double displacement =
                std::clamp(length * push.weights[k] * tangle.mobility[v], -limit, limit);
            tangle.x[v] += displacement * push.normal;
        }
    }
}

void find_clearance_pushes(const Tangle& tangle,
                           std::span<const NearPair> pairs,
                           double clearance,
                           std::vector<Push>& pushes) {
    for (const NearPair& pair : pairs) {
        const bool neighbours =
            share_vertex(tangle.surface, tangle.surface.triangles[at(pair.first)],
                         tangle.surface.triangles[at(pair.second)]);
        if (!pair.crosses && !neighbours) {
            add_vertex_faces(tangle, pair.first, pair.second, clearance, pushes);
            add_vertex_faces(tangle, pair.second, pair.first, clearance, pushes);
            add_edge_edges(tangle, pair.first, pair.second, clearance, pushes);
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
