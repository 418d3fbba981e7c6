#include "collide/contact_surface.h"

#include "base/parallel.h"
#include "state/rigid_motion.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace weft {

namespace {

void add_mesh(ContactSurface& surface,
              ContactObject object,
              std::span<const Triangle> triangles,
              const EdgeTopology& topology) {
    const auto index = static_cast<Index>(surface.objects.size());
    object.first_triangle = static_cast<Index>(surface.triangles.size());
    object.triangle_count = static_cast<Index>(triangles.size());
    surface.object_of_vertex.resize(at(object.first_vertex + object.vertex_count), index);
    std::vector<char> spoken_for(at(object.vertex_count), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        Triangle triangle = triangles[t];
        std::uint8_t owned = 0;
        std::array<Index, 3> across{};
        for (std::size_t k = 0; k < 3; ++k) {
            char& vertex = spoken_for[at(triangle[k])];
            owned = static_cast<std::uint8_t>(owned | (vertex ? 0 : 1 << k));
            vertex = 1;
            const MeshEdge& edge = topology.edges[at(topology.triangle_edges[t][k])];
            const bool first = edge.triangle[0] == static_cast<Index>(t);
            owned = static_cast<std::uint8_t>(owned | (first ? 8 << k : 0));
            const Index apex = edge.apex[first ? 1 : 0];
            across[k] = apex == k_no_index ? k_no_index : object.first_vertex + apex;
            triangle[k] += object.first_vertex;
        }
        surface.across.push_back(across);
        surface.triangles.push_back(triangle);
        surface.owned.push_back(owned);
    }
    surface.objects.push_back(std::move(object));
}

/// Adds what a body carries; its particles belong to the object, too.
void add_body(ContactSurface& surface, const Body& body, ContactBody carried) {
    ContactObject object{.name = body.name,
                         .first_vertex = body.first_vertex,
                         .vertex_count = body.vertex_count,
                         .thickness = body.thickness,
                         .least_thickness = body.thickness,
                         .friction = body.friction,
                         .static_friction = body.static_friction,
                         .body = static_cast<Index>(surface.bodies.size()),
                         .touches_itself = body.touches_itself};
    const Index end = body.first_particle + body.particle_count;
    const auto index = static_cast<Index>(surface.objects.size());
    surface.self_thickness.resize(at(end), body.thickness);
    add_mesh(surface, std::move(object), body.triangles, body.topology);
    surface.object_of_vertex.resize(at(end), index);
    carried.first_vertex = body.first_vertex;
    carried.vertex_count = body.vertex_count;
    carried.first_particle = body.first_particle;
    carried.particle_count = body.particle_count;
    surface.bodies.push_back(carried);
}

/// Lists the neighbours of each vertex.
void build_rings(ContactSurface& surface, std::size_t vertices) {
    std::vector<std::pair<Index, Index>> links;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        const Triangle& triangle = surface.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) {
            if (surface.owns_side(static_cast<Index>(t), k)) {
                links.emplace_back(triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
            }
        }
    }
    surface.ring_begin.assign(vertices + 1, 0);
    for (const auto& [a, b] : links) {
        ++surface.ring_begin[at(a) + 1];
        ++surface.ring_begin[at(b) + 1];
    }
    std::partial_sum(surface.ring_begin.begin(), surface.ring_begin.end(),
                     surface.ring_begin.begin());
    std::vector<Index> next(surface.ring_begin.begin(), surface.ring_begin.end() - 1);
    surface.ring.resize(2 * links.size());
    for (const auto& [a, b] : links) {
        surface.ring[at(next[at(a)]++)] = b;
        surface.ring[at(next[at(b)]++)] = a;
    }
}

const FrictionPair*
find_pair(std::span<const FrictionPair> table, const std::string& a, const std::string& b) {
    const std::array<std::string, 2> names{a, b};
    const auto found = std::find_if(table.begin(), table.end(), [&](const FrictionPair& pair) {
        return std::is_permutation(names.begin(), names.end(), pair.between.begin());
    });
    return found == table.end() ? nullptr : &*found;
}

bool are_off(const ContactSurface& surface, std::size_t a, std::size_t b, bool cloth_meets_cloth) {
    const auto is_cloth = [&](std::size_t i) {
        return !surface.objects[i].is_obstacle && surface.objects[i].body == k_no_index;
    };
    return (a == b && !surface.objects[a].touches_itself) ||
           (!cloth_meets_cloth && is_cloth(a) && is_cloth(b));
}

PairRule rule_between(const ContactObject& a,
                      const ContactObject& b,
                      std::span<const FrictionPair> friction) {
    const bool both_deformable = !a.is_obstacle && !b.is_obstacle;
    const double thickness =
        both_deformable ? 0.5 * (a.thickness + b.thickness) : std::max(a.thickness, b.thickness);
    if (const FrictionPair* pair = find_pair(friction, a.name, b.name)) {
        return {thickness, pair->friction, pair->static_friction.value_or(pair->friction)};
    }
    return {thickness, std::sqrt(a.friction * b.friction),
            std::sqrt(a.static_friction * b.static_friction)};
}

/// After their particles: what it takes to move a carried vertex, and rigid bodies as a whole.
void place_bodies(ContactSurface& surface) {
    for (ContactBody& body : surface.bodies) {
        parallel_for(at(body.vertex_count), [&](std::size_t i) {
            const std::size_t v = at(body.first_vertex) + i;
            const Carrier& carrier = *surface.carriers.of(static_cast<Index>(v));
            surface.inverse_mass[v] = 0.0;
            for (std::size_t k = 0; k < 4 && carrier.particles[k] != k_no_index; ++k) {
                surface.inverse_mass[v] += carrier.weights[k] * carrier.weights[k] *
                                           surface.inverse_mass[at(carrier.particles[k])];
            }
        });
        if (body.is_rigid) {
            const std::size_t p = at(body.first_particle);
            const FourPoints x{surface.start[p], surface.start[p + 1], surface.start[p + 2],
                               surface.start[p + 3]};
            body.centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
            body.inverse_inertia = (body.mass * inertia_of(x)).inverse();
        }
    }
}

void place_rigid(ContactSurface& surface,
                 ContactObject& object,
                 const Obstacle& obstacle,
                 double time,
                 double dt) {
    object.start = obstacle_pose(obstacle, time);
    object.end = obstacle_pose(obstacle, time + dt);
    const std::size_t first = at(object.first_vertex);
    parallel_for(obstacle.mesh.positions.size(), [&](std::size_t i) {
        const Vec3& x = obstacle.mesh.positions[i];
        surface.start[first + i] = object.start * x;
        surface.velocity[first + i] = (object.end * x - surface.start[first + i]) / dt;
    });
}

void place_deforming(ContactSurface& surface,
                     ContactObject& object,
                     const Obstacle& obstacle,
                     double time,
                     double dt) {
    const Pose pose_start = obstacle_pose(obstacle, time);
    const Pose pose_end = obstacle_pose(obstacle, time + dt);
    const Deformation::Positions start = obstacle_shape(obstacle, time);
    const Deformation::Positions end = obstacle_shape(obstacle, time + dt);
    const std::size_t first = at(object.first_vertex);
    const bool stays = parallel_reduce(
        start->size(), true,
        [&](std::size_t i) {
            const Vec3 x = pose_start * (*start)[i];
            const Vec3 v = (pose_end * (*end)[i] - x) / dt;
            const bool rests = v.isZero(0.0) && x == surface.start[first + i];
            surface.start[first + i] = x;
            surface.velocity[first + i] = v;
            return rests;
        },
        [](bool a, bool b) { return a && b; });
    object.motion_number += stays ? 0 : 1;
}

} // namespace

double ContactSurface::thickness_of(const std::array<Index, 4>& pair, PairKind kind) const {
    if (!is_deformable(pair[0]) || !is_deformable(pair[3])) {
        return rules[at(rule_of(pair[0], pair[3]))].thickness;
    }
    const auto own = [&](std::size_t i) { return self_thickness[at(pair[i])]; };
    const double first = kind == PairKind::VertexFace ? own(0) : std::min(own(0), own(1));
    const double last = std::min(own(2), own(3));
    return 0.5 * (first + (kind == PairKind::VertexFace ? std::min(own(1), last) : last));
}

std::vector<double> finest_thickness(const Cloth& cloth) {
    std::vector<double> finest(at(cloth.vertex_count), std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < cloth.triangles.size(); ++t) {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            longest = std::max(longest, rest_edge_length(cloth.rest[t], k));
        }
        for (const Index v : cloth.triangles[t]) {
            finest[at(v)] = std::min(finest[at(v)], cloth.rest[t].area / longest);
        }
    }
    return finest;
}

ContactSurface make_surface(const World& world, const ContactParams& contact) {
    ContactSurface surface;
    for (const Cloth& cloth : world.cloths) {
        const FabricParams& fabric = cloth.params.fabric;
        ContactObject object{.name = cloth.name, .is_obstacle = false};
        object.first_vertex = cloth.first_vertex;
        object.vertex_count = cloth.vertex_count;
        object.thickness = fabric.thickness;
        object.least_thickness = fabric.thickness;
        for (const double finest : finest_thickness(cloth)) {
            surface.self_thickness.push_back(std::min(fabric.thickness, finest));
            object.least_thickness =
                std::min(object.least_thickness, surface.self_thickness.back());
        }
        object.friction = fabric.friction;
        object.static_friction = fabric.static_friction.value_or(fabric.friction);
        add_mesh(surface, std::move(object), cloth.triangles, cloth.topology);
    }
    for (const Solid& solid : world.solids) {
        add_body(surface, solid.body, {});
    }
    for (const RigidBody& rigid : world.rigids) {
        add_body(surface, rigid.body, {.is_rigid = true, .mass = rigid.params.mass});
    }
    surface.carriers = make_carrier_table(world);
    surface.deformable_vertices = static_cast<Index>(world.vertex_count());
    surface.deformable_triangles = static_cast<Index>(surface.triangles.size());
    auto next_vertex = surface.deformable_vertices;
    for (const Obstacle& obstacle : world.obstacles) {
        ContactObject object{.name = obstacle.name, .is_obstacle = true};
        object.first_vertex = next_vertex;
        object.vertex_count = static_cast<Index>(obstacle.mesh.positions.size());
        object.friction = obstacle.params.friction;
        object.deforms = deforms(obstacle);
        object.static_friction = obstacle.params.static_friction.value_or(object.friction);
        next_vertex += object.vertex_count;
        add_mesh(surface, std::move(object), obstacle.mesh.triangles, obstacle.topology);
    }
    for (std::size_t a = 0; a < surface.objects.size(); ++a) {
        for (std::size_t b = 0; b < surface.objects.size(); ++b) {
            surface.rules.push_back(
                rule_between(surface.objects[a], surface.objects[b], contact.friction));
            surface.rules.back().is_off = are_off(surface, a, b, contact.self);
        }
    }
    const std::size_t vertices = at(next_vertex);
    surface.object_of_vertex.resize(vertices, 0);
    build_rings(surface, vertices);
    surface.start.assign(vertices, Vec3::Zero());
    surface.velocity.assign(vertices, Vec3::Zero());
    surface.inverse_mass.assign(vertices, 0.0);
    join_seams(surface, world);
    return surface;
}

void place_surface(ContactSurface& surface,
                   const World& world,
                   std::span<const Vec3> velocities,
                   std::span<const char> held,
                   double dt) {
    assert(velocities.size() == at(surface.deformable_vertices) &&
           held.size() == velocities.size());
    assert(world.vertex_count() == velocities.size() && dt > 0.0);
    join_seams(surface, world);
    parallel_for(velocities.size(), [&](std::size_t i) {
        surface.start[i] = world.positions[i];
        surface.velocity[i] = velocities[i];
        surface.inverse_mass[i] = held[i] ? 0.0 : 1.0 / world.masses[i];
    });
    place_bodies(surface);
    for (std::size_t o = 0; o < world.obstacles.size(); ++o) {
        const Obstacle& obstacle = world.obstacles[o];
        ContactObject& object =
            surface.objects[surface.objects.size() - world.obstacles.size() + o];
        if (object.deforms) {
            place_deforming(surface, object, obstacle, world.time, dt);
        } else {
            place_rigid(surface, object, obstacle, world.time, dt);
        }
    }
}

} // namespace weft
