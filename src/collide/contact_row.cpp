#include "collide/contact_row.h"

#include "collide/carried_motion.h"

namespace weft {

namespace {

/// Largest share of an overlap that one substep takes back (Bridson et al. 2002).
constexpr double k_overlap_share = 0.1;

/// Largest speed of parting, per overlap, 1/s. Larger: garments that start close to the skin jump;
/// smaller: they sink in for longer.
constexpr double k_parting_rate = 20.0;

/// A direction for sides that touch: of the face, or across both edges.
Vec3 fallback_normal(PairKind kind, const PairPoints& x) {
    Vec3 n = kind == PairKind::VertexFace ? (x[2] - x[1]).cross(x[3] - x[1])
                                          : (x[1] - x[0]).cross(x[3] - x[2]);
    const double length = n.norm();
    return length > 0.0 ? Vec3(n / length) : Vec3::UnitY();
}

Vec3 relative_velocity(const ContactRow& row, const ContactSurface& surface) {
    Vec3 v = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        v += row.weights[i] * velocity_of(surface, row.vertices[i]);
    }
    return v;
}

/// Sets one row right; returns the change of its relative velocity.
double settle(ContactRow& row, ContactSurface& surface, std::span<char> touched) {
    const Vec3 v = relative_velocity(row, surface);
    const double speed = row.normal.dot(v);
    const double impulse = std::max(0.0, row.impulse + row.mass * (row.least_speed - speed));
    const Vec3 across = v - speed * row.normal;
    Vec3 drag = row.drag - row.drag_mass * across;
    const double limit = row.friction * impulse;
    const double wanted = drag.norm();
    if (wanted > limit) {
        drag *= limit / wanted;
    }
    const Vec3 change = (impulse - row.impulse) * row.normal + (drag - row.drag);
    if (change.isZero(0.0)) {
        return 0.0;
    }
    row.impulse = impulse;
    row.drag = drag;
    push_pair(surface, row.vertices, row.weights, change, touched);
    return change.norm() / row.mass;
}

} // namespace

double parting_share(double dt) {
    return std::min(k_overlap_share, k_parting_rate * dt);
}

PairPoints start_points(const ContactSurface& surface, const std::array<Index, 4>& vertices) {
    return {surface.start[at(vertices[0])], surface.start[at(vertices[1])],
            surface.start[at(vertices[2])], surface.start[at(vertices[3])]};
}

PairPoints
displacements(const ContactSurface& surface, const std::array<Index, 4>& vertices, double dt) {
    return {dt * surface.velocity[at(vertices[0])], dt * surface.velocity[at(vertices[1])],
            dt * surface.velocity[at(vertices[2])], dt * surface.velocity[at(vertices[3])]};
}

ContactRow make_row(const ContactSurface& surface,
                    const Candidate& candidate,
                    const Separation& place,
                    double dt) {
    const PairRule& rule = surface.rules[at(candidate.rule)];
    const PairPoints x = start_points(surface, candidate.vertices);
    ContactRow row{.vertices = candidate.vertices,
                   .weights = place.weights,
                   .kind = candidate.kind,
                   .normal =
                       place.distance > 0.0 ? place.normal : fallback_normal(candidate.kind, x),
                   .mass = 0.0,
                   .least_speed = 0.0,
                   .friction = rule.friction};
    Vec3 apart = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        apart += row.weights[i] * x[i];
    }
    const PairMass mass = mass_of_pair(surface, row.vertices, row.weights, row.normal);
    row.mass = mass.along;
    row.drag_mass = mass.across;
    const double overlap =
        surface.thickness_of(candidate.vertices, candidate.kind) - row.normal.dot(apart);
    row.least_speed = overlap / dt * (overlap > 0.0 ? parting_share(dt) : 1.0);
    return row;
}

double sweep(std::span<ContactRow> rows, ContactSurface& surface, std::span<char> touched) {
    double largest = 0.0;
    for (ContactRow& row : rows) {
        if (row.mass > 0.0) { // 0: the closest points lie on vertices of infinite mass alone
            largest = std::max(largest, settle(row, surface, touched));
        }
    }
    follow_particles(surface, touched);
    return largest;
}

} // namespace weft
