#include "collide/contact_row.h"

#include "base/parallel.h"
#include "collide/friction.h"

#include <algorithm>

namespace weft {

namespace {

/// Largest fraction of an overlap that one substep takes back (Bridson et al. 2002).
constexpr double k_overlap_fraction = 0.1;

/// Largest speed of parting, per overlap, 1/s. Larger: garments that start close to the skin jump;
/// smaller: they sink in for longer.
constexpr double k_parting_rate = 20.0;

/// A direction for sides that touch: of the face, or perpendicular to both edges.
Vec3 fallback_normal(PairKind kind, const PairPoints& x) {
    Vec3 n = kind == PairKind::VertexFace ? (x[2] - x[1]).cross(x[3] - x[1])
                                          : (x[1] - x[0]).cross(x[3] - x[2]);
    const double length = n.norm();
    return length > 0.0 ? Vec3(n / length) : Vec3::UnitY();
}

/// What an impulse at a pair acts on: single vertices by their weights; and rigid bodies, by a
/// weight and a weighted arm.
struct PairTerms {
    struct OfVertex {
        Index vertex;
        double weight;
    };
    struct OfRigid {
        const ContactBody* body;
        double weight;
        Vec3 arm; ///< from the centre, weighted, m
    };
    std::array<OfVertex, 16> vertices;
    std::array<OfRigid, 4> rigids;
    std::size_t vertex_count = 0, rigid_count = 0;

    void add(Index vertex, double weight) {
        const auto end = vertices.begin() + static_cast<long>(vertex_count);
        const auto known = std::find_if(vertices.begin(), end,
                                        [&](const OfVertex& one) { return one.vertex == vertex; });
        if (known == end) {
            vertices[vertex_count++] = {vertex, weight};
        } else {
            known->weight += weight;
        }
    }

    void add(const ContactBody& body, double weight, const Vec3& arm) {
        const auto end = rigids.begin() + static_cast<long>(rigid_count);
        const auto known = std::find_if(rigids.begin(), end,
                                        [&](const OfRigid& one) { return one.body == &body; });
        if (known == end) {
            rigids[rigid_count++] = {&body, weight, weight * arm};
        } else {
            known->weight += weight;
            known->arm += weight * arm;
        }
    }
};

PairTerms terms_of(const ContactSurface& surface,
                   const std::array<Index, 4>& vertices,
                   const std::array<double, 4>& weights) {
    PairTerms terms;
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = vertices[i];
        if (weights[i] == 0.0 || surface.inverse_mass[at(v)] == 0.0) {
            continue;
        }
        const Embedding* embedding =
            surface.is_deformable(v) ? surface.embeddings.find(v) : nullptr;
        const ContactBody* body = embedding == nullptr ? nullptr : surface.body_of(v);
        if (embedding == nullptr) {
            terms.add(v, weights[i]);
        } else if (body->is_rigid) {
            terms.add(*body, weights[i], surface.start[at(v)] - body->centre);
        } else {
            for (std::size_t k = 0; k < 4 && embedding->particles[k] != k_no_index; ++k) {
                terms.add(embedding->particles[k], weights[i] * embedding->weights[k]);
            }
        }
    }
    return terms;
}

} // namespace

Vec3 velocity_of(const ContactSurface& surface, Index vertex) {
    const Embedding* embedding =
        surface.is_deformable(vertex) ? surface.embeddings.find(vertex) : nullptr;
    if (embedding == nullptr) {
        return surface.velocity[at(vertex)];
    }
    Vec3 velocity = Vec3::Zero();
    for (std::size_t k = 0; k < 4 && embedding->particles[k] != k_no_index; ++k) {
        velocity += embedding->weights[k] * surface.velocity[at(embedding->particles[k])];
    }
    return velocity;
}

PairMass mass_of_pair(const ContactSurface& surface,
                      const std::array<Index, 4>& vertices,
                      const std::array<double, 4>& weights,
                      const Vec3& normal) {
    double along = 0.0;
    double all = 0.0; // compliance in all three directions
    if (surface.bodies.empty()) {
        for (std::size_t i = 0; i < 4; ++i) {
            along += weights[i] * weights[i] * surface.inverse_mass[at(vertices[i])];
        }
        const double mass = along > 0.0 ? 1.0 / along : 0.0;
        return {mass, mass};
    }
    const PairTerms terms = terms_of(surface, vertices, weights);
    for (std::size_t i = 0; i < terms.vertex_count; ++i) {
        const auto& [vertex, weight] = terms.vertices[i];
        const double compliance = weight * weight * surface.inverse_mass[at(vertex)];
        along += compliance;
        all += 2.0 * compliance; // one tangential direction is as soft as any
    }
    for (std::size_t i = 0; i < terms.rigid_count; ++i) {
        const auto& [body, weight, arm] = terms.rigids[i];
        const double straight = weight * weight / body->mass;
        const auto turning = [&](const Vec3& direction) {
            const Vec3 torque = arm.cross(direction);
            return torque.dot(body->inverse_inertia * torque);
        };
        along += straight + turning(normal);
        all += 2.0 * straight + turning(Vec3::UnitX()) + turning(Vec3::UnitY()) +
               turning(Vec3::UnitZ());
    }
    return along > 0.0 ? PairMass{1.0 / along, 1.0 / std::max(along, all - along)}
                       : PairMass{0.0, 0.0};
}

void push_pair(ContactSurface& surface,
               const std::array<Index, 4>& vertices,
               const std::array<double, 4>& weights,
               const Vec3& impulse,
               std::span<char> touched) {
    if (surface.bodies.empty()) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t v = at(vertices[i]);
            const double compliance = weights[i] * surface.inverse_mass[v];
            if (compliance != 0.0) {
                surface.velocity[v] += compliance * impulse;
                touched[v] = 1;
            }
        }
        return;
    }
    const PairTerms terms = terms_of(surface, vertices, weights);
    for (std::size_t i = 0; i < terms.vertex_count; ++i) {
        const auto& [vertex, weight] = terms.vertices[i];
        surface.velocity[at(vertex)] += weight * surface.inverse_mass[at(vertex)] * impulse;
        touched[at(vertex)] = 1;
    }
    for (std::size_t i = 0; i < terms.rigid_count; ++i) {
        const auto& [body, weight, arm] = terms.rigids[i];
        const Vec3 straight = weight / body->mass * impulse;
        const Vec3 turning = body->inverse_inertia * arm.cross(impulse);
        for (std::size_t p = at(body->first_particle); p < at(body->first_particle) + 4; ++p) {
            surface.velocity[p] += straight + turning.cross(surface.start[p] - body->centre);
            touched[p] = 1;
        }
    }
}

void follow_particles(ContactSurface& surface, std::span<char> touched) {
    for (const ContactBody& body : surface.bodies) {
        const auto begin = touched.begin() + body.first_particle;
        if (std::find(begin, begin + body.particle_count, 1) == begin + body.particle_count) {
            continue;
        }
        parallel_for(at(body.vertex_count), [&](std::size_t i) {
            const Index v = body.first_vertex + static_cast<Index>(i);
            surface.velocity[at(v)] = velocity_of(surface, v);
            touched[at(v)] = 1;
        });
    }
}

namespace {

Vec3 relative_velocity(const ContactRow& row, const ContactSurface& surface) {
    Vec3 v = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
        v += row.weights[i] * velocity_of(surface, row.vertices[i]);
    }
    return v;
}

/// Applies the impulse that one row asks for; returns the change of its relative velocity.
double apply(ContactRow& row, ContactSurface& surface, std::span<char> touched) {
    const Vec3 v = relative_velocity(row, surface);
    const double speed = row.normal.dot(v);
    const double impulse = std::max(0.0, row.impulse + row.mass * (row.least_speed - speed));
    const Vec3 tangential = v - speed * row.normal;
    const Vec3 friction_impulse = limit_friction_impulse(
        row.friction_impulse - row.tangential_mass * tangential, row.friction * impulse);
    const Vec3 change =
        (impulse - row.impulse) * row.normal + (friction_impulse - row.friction_impulse);
    if (change.isZero(0.0)) {
        return 0.0;
    }
    row.impulse = impulse;
    row.friction_impulse = friction_impulse;
    push_pair(surface, row.vertices, row.weights, change, touched);
    return change.norm() / row.mass;
}

} // namespace

double parting_fraction(double dt) {
    return std::min(k_overlap_fraction, k_parting_rate * dt);
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
    row.tangential_mass = mass.tangential;
    const double overlap =
        surface.thickness_of(candidate.vertices, candidate.kind) - row.normal.dot(apart);
    row.least_speed = overlap / dt * (overlap > 0.0 ? parting_fraction(dt) : 1.0);
    return row;
}

double sweep(std::span<ContactRow> rows, ContactSurface& surface, std::span<char> touched) {
    double largest = 0.0;
    for (ContactRow& row : rows) {
        if (row.mass > 0.0) { // 0: the closest points lie on vertices of infinite mass alone
            largest = std::max(largest, apply(row, surface, touched));
        }
    }
    follow_particles(surface, touched);
    return largest;
}

} // namespace weft
