#include "collide/contact_search.h"

#include "base/parallel.h"
#include "collide/friction.h"

#include <algorithm>

namespace weft {

namespace {

/// Fraction of the rest gap that pushing sides may use up. Larger: heavy loads are carried more
/// softly; smaller: nothing is left between the least gap and where impacts are felt.
constexpr double k_barrier_fraction = 0.7;

/// How a gap turns with the body that an obstacle's vertex belongs to, m: what sticks to the body
/// at a distance moves with the body's motion there, not with that of the body's surface.
Vec3 turn_of_gap(const ContactSurface& surface, Index vertex, const Vec3& gap) {
    const ContactObject& object = surface.objects[at(surface.object_of_vertex[at(vertex)])];
    return object.end.rotation * (object.start.rotation.transpose() * gap) - gap;
}

/// Gap and motion of a pair whose closest points are those of `place`.
Contact make_contact(const ContactSurface& surface,
                     const Candidate& candidate,
                     const Separation& place,
                     double dt) {
    const ContactRow row = make_row(surface, candidate, place, dt);
    const PairRule& rule = surface.rules[at(candidate.rule)];
    const double thickness = surface.thickness_of(candidate.vertices, candidate.kind);
    Contact contact{.pair = candidate.vertices,
                    .kind = candidate.kind,
                    .vertices = candidate.vertices,
                    .weights = row.weights,
                    .normal = row.normal,
                    .gap = 0.0,
                    .thickness = thickness,
                    .rest_gap = thickness,
                    .barrier_width = k_barrier_fraction * thickness,
                    .mass = row.mass,
                    .friction = rule.friction,
                    .static_friction = rule.static_friction,
                    .obstacle_displacement = Vec3::Zero()};
    Vec3 apart = Vec3::Zero();
    Vec3 speed = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = candidate.vertices[i];
        apart += row.weights[i] * surface.start[at(v)];
        speed += row.weights[i] * surface.velocity[at(v)];
        if (!surface.is_deformable(v)) {
            contact.vertices[i] = k_no_index;
            contact.obstacle_displacement += dt * row.weights[i] * surface.velocity[at(v)];
        }
    }
    contact.gap = row.normal.dot(apart);
    for (const Index v : {candidate.vertices[0], candidate.vertices[3]}) {
        if (!surface.is_deformable(v)) {
            const Vec3 turn = turn_of_gap(surface, v, apart);
            contact.obstacle_displacement -= turn - row.normal.dot(turn) * row.normal;
        }
    }
    const Vec3 sliding = speed - row.normal.dot(speed) * row.normal;
    contact.slides = is_sliding(sliding.norm(), 1.0);
    return contact;
}

/// Sine of the angle by which a connection may lean towards a triangle beside it. Smaller: contacts
/// at shared edges are lost to rounding; larger: what slides far in a substep is lifted, and
/// braked.
constexpr double k_lean = 1e-5;

/// False when the bounds of the sides alone show that they are further apart than `reach`.
bool may_be_near(PairKind kind, const PairPoints& x, double reach) {
    for (Eigen::Index k = 0; k < 3; ++k) {
        const bool vertex_face = kind == PairKind::VertexFace;
        const double low1 = vertex_face ? x[0][k] : std::min(x[0][k], x[1][k]);
        const double high1 = vertex_face ? x[0][k] : std::max(x[0][k], x[1][k]);
        const double second = vertex_face ? x[1][k] : x[2][k];
        const double low2 = std::min({x[2][k], x[3][k], second});
        const double high2 = std::max({x[2][k], x[3][k], second});
        if (low1 > high2 + reach || low2 > high1 + reach) {
            return false;
        }
    }
    return true;
}

/// Does `normal` lean towards the triangle on `apex`'s side of the edge (a, b)?
bool leans_to_triangle(
    const ContactSurface& surface, const Vec3& normal, Index a, Index b, Index apex) {
    if (apex == k_no_index) {
        return false;
    }
    const Vec3& origin = surface.start[at(a)];
    const Vec3 edge = surface.start[at(b)] - origin;
    const Vec3 side = surface.start[at(apex)] - origin;
    const double length_squared = edge.squaredNorm();
    const Vec3 inward =
        length_squared > 0.0 ? Vec3(side - edge.dot(side) / length_squared * edge) : side;
    return normal.dot(inward) > k_lean * inward.norm();
}

bool leans_to_ring(const ContactSurface& surface, const Vec3& normal, Index v) {
    for (Index i = surface.ring_begin[at(v)]; i < surface.ring_begin[at(v) + 1]; ++i) {
        const Vec3 along = surface.start[at(surface.ring[at(i)])] - surface.start[at(v)];
        if (normal.dot(along) > k_lean * along.norm()) {
            return true;
        }
    }
    return false;
}

bool vertex_face_is_nearest(const ContactSurface& surface,
                            const Candidate& candidate,
                            const Separation& place) {
    const Index t = candidate.triangles[0];
    const Triangle& corners = surface.triangles[at(t)];
    std::array<bool, 3> used{};
    for (std::size_t k = 0; k < 3; ++k) {
        used[k] = place.weights[k + 1] != 0.0;
    }
    const int count = int(used[0]) + int(used[1]) + int(used[2]);
    if (count == 3) {
        return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const Index a = corners[(k + 1) % 3];
        const Index b = corners[(k + 2) % 3];
        if (count == 2 && !used[k]) { // on the side opposite to corner k
            return surface.owns_side(t, k) &&
                   !leans_to_triangle(surface, place.normal, a, b, surface.opposite[at(t)][k]);
        }
        if (count == 1 && used[k]) {
            return surface.owns_corner(t, k) && !leans_to_ring(surface, place.normal, corners[k]);
        }
    }
    return true;
}

bool leans_beside_edge(
    const ContactSurface& surface, const Vec3& normal, Index t, Index a, Index b) {
    const Triangle& corners = surface.triangles[at(t)];
    for (std::size_t k = 0; k < 3; ++k) {
        if (corners[k] != a && corners[k] != b) {
            return leans_to_triangle(surface, normal, a, b, corners[k]) ||
                   leans_to_triangle(surface, normal, a, b, surface.opposite[at(t)][k]);
        }
    }
    return false;
}

} // namespace

bool is_nearest_here(const ContactSurface& surface,
                     const Candidate& candidate,
                     const Separation& place) {
    if (place.distance == 0.0) {
        return true;
    }
    if (candidate.kind == PairKind::VertexFace) {
        return vertex_face_is_nearest(surface, candidate, place);
    }
    const auto& w = place.weights;
    if (w[0] == 0.0 || w[1] == 0.0 || w[2] == 0.0 || w[3] == 0.0) {
        return false; // a vertex and an edge: the vertex's pair with a face has it
    }
    const auto& v = candidate.vertices;
    return !leans_beside_edge(surface, -place.normal, candidate.triangles[0], v[0], v[1]) &&
           !leans_beside_edge(surface, place.normal, candidate.triangles[1], v[2], v[3]);
}

std::optional<Separation> near_place(const ContactSurface& surface, const Candidate& candidate) {
    const double reach = k_reach * surface.thickness_of(candidate.vertices, candidate.kind);
    const PairPoints x = start_points(surface, candidate.vertices);
    if (!may_be_near(candidate.kind, x, reach)) {
        return {};
    }
    const Separation place = separation(candidate.kind, x);
    return place.distance < reach && is_nearest_here(surface, candidate, place)
               ? std::optional(place)
               : std::nullopt;
}

void ContactSearch::find(const ContactSurface& surface,
                         std::span<const Candidate> candidates,
                         std::span<const FrictionHistory> history,
                         double dt,
                         std::vector<Contact>& contacts) {
    recall_.read(surface, history);
    contacts.clear();
    parallel_collect(
        candidates.size(),
        [&](std::size_t i, std::vector<Contact>& found) {
            const auto place = near_place(surface, candidates[i]);
            if (!place || place->distance == 0.0) {
                return;
            }
            Contact contact = make_contact(surface, candidates[i], *place, dt);
            if (contact.mass > 0.0) {
                const double rest_gap = recall_.recall(surface, contact);
                contact.rest_gap = rest_gap + (contact.thickness - rest_gap) * parting_fraction(dt);
                contact.barrier_width = k_barrier_fraction * contact.rest_gap;
                found.push_back(contact);
            }
        },
        chunks_, contacts);
    recall_.distribute(surface, contacts);
}

Contact make_impact_contact(const ContactSurface& surface,
                            const Candidate& candidate,
                            double toi,
                            double dt) {
    const PairPoints start = start_points(surface, candidate.vertices);
    const PairPoints motion = displacements(surface, candidate.vertices, dt);
    PairPoints x = start;
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] += toi * motion[i];
    }
    Contact contact = make_contact(surface, candidate, separation(candidate.kind, x), dt);
    contact.met = true;
    contact.rest_gap = std::min(contact.rest_gap, contact.gap);
    contact.barrier_width = std::min(
        contact.barrier_width, k_barrier_fraction * separation(candidate.kind, start).distance);
    return contact;
}

ContactRow guard_row(const Contact& contact, double dt) {
    const double least_gap =
        std::min((1.0 - k_barrier_fraction) * contact.thickness, 0.8 * contact.gap);
    return {.vertices = contact.pair,
            .weights = contact.weights,
            .kind = contact.kind,
            .normal = contact.normal,
            .mass = contact.mass,
            .least_speed = (least_gap - contact.gap) / dt,
            .friction = 0.0};
}

} // namespace weft
