#include "collide/carried_motion.h"

#include "base/parallel.h"

#include <algorithm>

namespace weft {

namespace {

/// The shares of a pair on what moves: single vertices, and rigid bodies, on which a weighted sum
/// of forces acts at a weighted sum of arms.
struct Shares {
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
        const auto known = std::find_if(
            vertices.begin(), end, [&](const OfVertex& share) { return share.vertex == vertex; });
        if (known == end) {
            vertices[vertex_count++] = {vertex, weight};
        } else {
            known->weight += weight;
        }
    }

    void add(const ContactBody& body, double weight, const Vec3& arm) {
        const auto end = rigids.begin() + static_cast<long>(rigid_count);
        const auto known = std::find_if(rigids.begin(), end,
                                        [&](const OfRigid& share) { return share.body == &body; });
        if (known == end) {
            rigids[rigid_count++] = {&body, weight, weight * arm};
        } else {
            known->weight += weight;
            known->arm += weight * arm;
        }
    }
};

Shares shares_of(const ContactSurface& surface,
                 const std::array<Index, 4>& vertices,
                 const std::array<double, 4>& weights) {
    Shares shares;
    for (std::size_t i = 0; i < 4; ++i) {
        const Index v = vertices[i];
        if (weights[i] == 0.0 || surface.inverse_mass[at(v)] == 0.0) {
            continue;
        }
        const Carrier* carrier = surface.is_deformable(v) ? surface.carriers.of(v) : nullptr;
        const ContactBody* body = carrier == nullptr ? nullptr : surface.body_of(v);
        if (carrier == nullptr) {
            shares.add(v, weights[i]);
        } else if (body->is_rigid) {
            shares.add(*body, weights[i], surface.start[at(v)] - body->centre);
        } else {
            for (std::size_t k = 0; k < 4 && carrier->particles[k] != k_no_index; ++k) {
                shares.add(carrier->particles[k], weights[i] * carrier->weights[k]);
            }
        }
    }
    return shares;
}

} // namespace

Vec3 velocity_of(const ContactSurface& surface, Index vertex) {
    const Carrier* carrier = surface.is_deformable(vertex) ? surface.carriers.of(vertex) : nullptr;
    if (carrier == nullptr) {
        return surface.velocity[at(vertex)];
    }
    Vec3 velocity = Vec3::Zero();
    for (std::size_t k = 0; k < 4 && carrier->particles[k] != k_no_index; ++k) {
        velocity += carrier->weights[k] * surface.velocity[at(carrier->particles[k])];
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
    const Shares shares = shares_of(surface, vertices, weights);
    for (std::size_t i = 0; i < shares.vertex_count; ++i) {
        const auto& [vertex, weight] = shares.vertices[i];
        const double compliance = weight * weight * surface.inverse_mass[at(vertex)];
        along += compliance;
        all += 2.0 * compliance; // one direction across is as soft as any
    }
    for (std::size_t i = 0; i < shares.rigid_count; ++i) {
        const auto& [body, weight, arm] = shares.rigids[i];
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
            const double share = weights[i] * surface.inverse_mass[v];
            if (share != 0.0) {
                surface.velocity[v] += share * impulse;
                touched[v] = 1;
            }
        }
        return;
    }
    const Shares shares = shares_of(surface, vertices, weights);
    for (std::size_t i = 0; i < shares.vertex_count; ++i) {
        const auto& [vertex, weight] = shares.vertices[i];
        surface.velocity[at(vertex)] += weight * surface.inverse_mass[at(vertex)] * impulse;
        touched[at(vertex)] = 1;
    }
    for (std::size_t i = 0; i < shares.rigid_count; ++i) {
        const auto& [body, weight, arm] = shares.rigids[i];
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

} // namespace weft
