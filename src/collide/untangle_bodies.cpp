#include "collide/untangle_bodies.h"

#include "base/parallel.h"

#include <numeric>

namespace weft {

namespace {

constexpr double k_anywhere = 1e30;

/// One object of the surface by itself, its triangles turned over when `side` is -1.
NearestSurface surface_of(const Tangle& tangle, const ContactObject& object, double side) {
    const auto first = tangle.x.begin() + object.first_vertex;
    std::vector<Triangle> triangles;
    for (Index i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = tangle.surface.triangles[at(object.first_triangle + i)];
        const Index o = object.first_vertex;
        triangles.push_back(side > 0.0 ? Triangle{t[0] - o, t[1] - o, t[2] - o}
                                       : Triangle{t[0] - o, t[2] - o, t[1] - o});
    }
    return NearestSurface({first, first + object.vertex_count}, triangles);
}

bool is_closed(const Tangle& tangle, const ContactObject& object) {
    for (Index i = 0; i < object.triangle_count; ++i) {
        const auto& opposite = tangle.surface.opposite[at(object.first_triangle + i)];
        if (std::find(opposite.begin(), opposite.end(), k_no_index) != opposite.end()) {
            return false;
        }
    }
    return true;
}

/// Area that looks away from the obstacles less that which looks towards them, m^2.
double outward_area(const Tangle& tangle,
                    const ContactObject& cloth,
                    std::span<const StandingBody> obstacles) {
    return parallel_sum(at(cloth.triangle_count), [&](std::size_t i) {
        const auto c = tangle.corners(cloth.first_triangle + static_cast<Index>(i));
        const Vec3 area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
        std::optional<SurfacePoint> nearest;
        for (const StandingBody& body : obstacles) {
            const double reach = nearest ? std::abs(nearest->height) : k_anywhere;
            if (const auto found = body.surface.find((c[0] + c[1] + c[2]) / 3.0, reach)) {
                nearest = found;
            }
        }
        return nearest ? area.dot(nearest->normal) : 0.0;
    });
}

/// Sum of the heights (m) of what moves over an open surface.
double heights_above(const Tangle& tangle, const NearestSurface& surface) {
    return parallel_sum(tangle.x.size(), [&](std::size_t v) {
        if (tangle.mobility[v] == 0.0) {
            return 0.0;
        }
        const auto found = surface.find(tangle.x[v], k_anywhere);
        return found && !found->is_on_boundary ? found->height : 0.0;
    });
}

} // namespace

std::vector<StandingBody> find_bodies(const Tangle& tangle) {
    std::vector<StandingBody> bodies;
    const auto add = [&](std::size_t o, double side) {
        bodies.push_back(
            {static_cast<Index>(o), side, surface_of(tangle, tangle.surface.objects[o], side)});
    };
    const auto side_by_heights = [&](const ContactObject& object) {
        return heights_above(tangle, surface_of(tangle, object, 1.0)) < 0.0 ? -1.0 : 1.0;
    };
    for (std::size_t o = 0; o < tangle.roles.size(); ++o) {
        const ContactObject& object = tangle.surface.objects[o];
        if (tangle.roles[o] == TangleRole::Stands && object.id.is_obstacle()) {
            add(o, is_closed(tangle, object) ? 1.0 : side_by_heights(object));
        }
    }
    const std::size_t obstacles = bodies.size();
    for (std::size_t o = 0; o < tangle.roles.size(); ++o) {
        const ContactObject& object = tangle.surface.objects[o];
        if (tangle.roles[o] == TangleRole::Stands && !object.id.is_obstacle()) {
            const double outward = outward_area(tangle, object, std::span(bodies).first(obstacles));
            add(o, outward != 0.0 ? std::copysign(1.0, outward) : side_by_heights(object));
        }
    }
    return bodies;
}

BodyPushes::BodyPushes(const Tangle& tangle)
    : bodies_(find_bodies(tangle)), body_of_object_(tangle.roles.size(), bodies_.size()),
      looked_at_(bodies_.size(), std::vector<char>(tangle.x.size(), 0)) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        body_of_object_[at(bodies_[b].object)] = b;
    }
}

void BodyPushes::find(const Tangle& tangle,
                      std::span<const NearPair> pairs,
                      double clearance,
                      std::vector<Push>& pushes) {
    for (const NearPair& pair : pairs) {
        if (tangle.stands(pair.second)) {
            find_columns(tangle, pair, clearance, pushes);
        }
    }
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        find_vertices_behind(tangle, pairs, b, clearance, pushes);
    }
}

/// Where a triangle that crosses a body's triangle, or is near it, is too low over it.
void BodyPushes::find_columns(const Tangle& tangle,
                              const NearPair& pair,
                              double clearance,
                              std::vector<Push>& pushes) {
    const ContactSurface& surface = tangle.surface;
    const Triangle& upper = surface.triangles[at(pair.first)];
    const Index lower = surface.triangles[at(pair.second)][0];
    const double least = clearance * surface.rules[at(surface.rule_of(upper[0], lower))].thickness;
    const StandingBody& body = bodies_[body_of_object_[at(surface.object_of_vertex[at(lower)])]];
    const auto base = tangle.corners(pair.second);
    const Vec3 normal = body.side * triangle_normal(base[0], base[1], base[2]);
    if (normal.isZero()) {
        return;
    }
    gaps_.clear();
    column_gaps(tangle.corners(pair.first), base, normal, gaps_);
    for (const ColumnGap& gap : gaps_) {
        if (gap.height < least && (pair.crosses || gap.height > -least)) {
            pushes.push_back({{upper[0], upper[1], upper[2], k_no_index},
                              {gap.weights[0], gap.weights[1], gap.weights[2], 0.0},
                              normal,
                              normal.dot(gap.base) + least});
        }
    }
}

/// Spreads over the cloth from the triangles that cross the body, as far as vertices are behind it.
void BodyPushes::find_vertices_behind(const Tangle& tangle,
                                      std::span<const NearPair> pairs,
                                      std::size_t body,
                                      double clearance,
                                      std::vector<Push>& pushes) {
    const ContactSurface& surface = tangle.surface;
    std::vector<char>& looked_at = looked_at_[body];
    for (const NearPair& pair : pairs) {
        const Index other = surface.triangles[at(pair.second)][0];
        if (pair.crosses && surface.object_of_vertex[at(other)] == bodies_[body].object) {
            for (const Index v : surface.triangles[at(pair.first)]) {
                looked_at[at(v)] = 1;
            }
        }
    }
    front_.clear();
    for (std::size_t v = 0; v < looked_at.size(); ++v) {
        if (looked_at[v]) {
            front_.push_back(static_cast<Index>(v));
        }
    }
    for (std::size_t i = 0; i < front_.size(); ++i) {
        const std::size_t v = at(front_[i]);
        const double least =
            clearance *
            surface.rules[at(surface.rule_of(front_[i], first_vertex_of(surface, body)))].thickness;
        const auto found = bodies_[body].surface.find(tangle.x[v], k_anywhere);
        if (!found || found->is_on_boundary || found->height >= least) {
            continue;
        }
        pushes.push_back({{front_[i], k_no_index, k_no_index, k_no_index},
                          {1.0, 0.0, 0.0, 0.0},
                          found->normal,
                          found->normal.dot(found->place) + least});
        for (Index r = surface.ring_begin[v]; r < surface.ring_begin[v + 1]; ++r) {
            char& seen = looked_at[at(surface.ring[at(r)])];
            if (!seen) {
                seen = 1;
                front_.push_back(surface.ring[at(r)]);
            }
        }
    }
}

Index BodyPushes::first_vertex_of(const ContactSurface& surface, std::size_t body) const {
    return surface.objects[at(bodies_[body].object)].first_vertex;
}

} // namespace weft
