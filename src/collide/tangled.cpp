#include "collide/tangled.h"

#include "base/parallel.h"
#include "geometry/closest_points.h"

#include <algorithm>
#include <set>

namespace weft {

namespace {

/// Greatest speed at which a caught vertex is drawn out, m/s. Larger: cloth jumps when a pinch
/// opens; smaller: it stays caught for longer.
constexpr double k_drawing_speed = 0.5;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

std::span<const Triangle> triangles_of(const ContactSurface& surface, const ContactObject& object) {
    return std::span(surface.triangles)
        .subspan(at(object.first_triangle), at(object.triangle_count));
}

bool is_closed(const ContactSurface& surface, const ContactObject& object) {
    for (Index t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t) {
        const auto& across = surface.across[at(t)];
        if (std::find(across.begin(), across.end(), k_no_index) != across.end()) {
            return false;
        }
    }
    return true;
}

/// Does the edge from a to b cross the half line from p along +y, all seen along x? Ends are taken
/// in the order of their height, so that triangles agree about an edge they share.
bool is_crossed(const Vec3& p, const Vec3& a, const Vec3& b) {
    if ((a.z() > p.z()) == (b.z() > p.z())) {
        return false;
    }
    const Vec3& low = a.z() < b.z() ? a : b;
    const Vec3& high = a.z() < b.z() ? b : a;
    const double share = (p.z() - low.z()) / (high.z() - low.z());
    return p.y() < low.y() + share * (high.y() - low.y());
}

/// How often the surface winds around p: the signed count of its faces along +x.
int winding_number(std::span<const Triangle> triangles, std::span<const Vec3> x, const Vec3& p) {
    int winding = 0;
    for (const Triangle& t : triangles) {
        const Vec3& a = x[at(t[0])];
        const Vec3& b = x[at(t[1])];
        const Vec3& c = x[at(t[2])];
        if (is_crossed(p, a, b) == (is_crossed(p, b, c) == is_crossed(p, c, a))) {
            const Vec3 n = (b - a).cross(c - a);
            const double ahead = n.dot(a - p); // its sign, by that of n.x, is where the face lies
            if (n.x() > 0.0 && ahead > 0.0) {
                ++winding;
            } else if (n.x() < 0.0 && ahead < 0.0) {
                --winding;
            }
        }
    }
    return winding;
}

struct NearestPlace {
    double distance = std::numeric_limits<double>::infinity();
    Vec3 place = Vec3::Zero(), velocity = Vec3::Zero();
};

NearestPlace
nearest_place(const ContactSurface& surface, std::span<const Triangle> triangles, const Vec3& p) {
    NearestPlace nearest;
    for (const Triangle& t : triangles) {
        const auto& x = surface.start;
        const Vec3 w = closest_weights_on_triangle(p, x[at(t[0])], x[at(t[1])], x[at(t[2])]);
        const Vec3 place = w[0] * x[at(t[0])] + w[1] * x[at(t[1])] + w[2] * x[at(t[2])];
        const double distance = (place - p).norm();
        if (distance < nearest.distance) {
            const auto& v = surface.velocity;
            nearest = {distance, place,
                       w[0] * v[at(t[0])] + w[1] * v[at(t[1])] + w[2] * v[at(t[2])]};
        }
    }
    return nearest;
}

} // namespace

void Tangled::find(const ContactSurface& surface, std::span<const std::array<Index, 2>> crossings) {
    caught_.clear();
    const auto object_of = [&](Index triangle) {
        return surface.object_of_vertex[at(surface.triangles[at(triangle)][0])];
    };
    const std::size_t count = at(surface.deformable_vertices);
    std::set<Index> obstacles;
    for (const auto& pair : crossings) {
        const Index object = object_of(pair[1]); // the higher number, so an obstacle if either is
        if (surface.objects[at(object)].is_obstacle &&
            is_closed(surface, surface.objects[at(object)])) {
            obstacles.insert(object);
        }
    }
    for (const Index obstacle : obstacles) {
        Caught caught{obstacle, std::vector<char>(count, 0), std::vector<char>(count, 0)};
        const auto triangles = triangles_of(surface, surface.objects[at(obstacle)]);
        Eigen::AlignedBox3d box;
        for (const Triangle& t : triangles) {
            box.extend(surface.start[at(t[0])]);
            box.extend(surface.start[at(t[1])]);
            box.extend(surface.start[at(t[2])]);
        }
        parallel_for(count, [&](std::size_t v) {
            const Vec3& x = surface.start[v];
            caught.inside[v] =
                box.contains(x) && winding_number(triangles, surface.start, x) > 0 ? 1 : 0;
        });
        caught.flags = caught.inside;
        for (const auto& pair : crossings) {
            if (object_of(pair[1]) == obstacle) {
                const Triangle& t = surface.triangles[at(pair[0])];
                const bool has_inside = std::any_of(
                    t.begin(), t.end(), [&](Index v) { return caught.inside[at(v)] != 0; });
                for (const Index v : t) {
                    caught.flags[at(v)] |= static_cast<char>(has_inside ? 0 : 1);
                }
            }
        }
        caught_.push_back(std::move(caught));
    }
}

void Tangled::drop_pairs(const ContactSurface& surface, std::vector<Candidate>& candidates) const {
    std::erase_if(candidates, [&](const Candidate& candidate) {
        return std::any_of(caught_.begin(), caught_.end(), [&](const Caught& caught) {
            const auto& v = candidate.vertices;
            const bool meets = surface.object_of_vertex[at(v[0])] == caught.obstacle ||
                               surface.object_of_vertex[at(v[3])] == caught.obstacle;
            return meets && std::any_of(v.begin(), v.end(), [&](Index i) {
                       return surface.is_deformable(i) && caught.flags[at(i)] != 0;
                   });
        });
    });
}

void Tangled::draw_out(ContactSurface& surface, double dt) const {
    parallel_for(at(surface.deformable_vertices), [&](std::size_t v) {
        const auto holds = [&](const Caught& caught) { return caught.inside[v] != 0; };
        if (surface.inverse_mass[v] == 0.0 ||
            std::count_if(caught_.begin(), caught_.end(), holds) != 1) {
            return;
        }
        const Caught& caught = *std::find_if(caught_.begin(), caught_.end(), holds);
        const auto triangles = triangles_of(surface, surface.objects[at(caught.obstacle)]);
        const NearestPlace out = nearest_place(surface, triangles, surface.start[v]);
        if (out.distance > 0.0) {
            const Vec3 n = (out.place - surface.start[v]) / out.distance;
            const double wanted = std::min(1.5 * out.distance / dt, k_drawing_speed);
            const double speed = n.dot(surface.velocity[v] - out.velocity);
            surface.velocity[v] += std::max(0.0, wanted - speed) * n;
        }
    });
}

} // namespace weft
