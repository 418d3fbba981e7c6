#include "collide/contact_surface.h"

#include "base/parallel.h"
#include "collide/friction.h"
#include "state/rigid_motion.h"

#include <Eigen/Dense>
#include <fmt/core.h>

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
    std::vector<char> is_represented(at(object.vertex_count), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        Triangle triangle = triangles[t];
        std::uint8_t owned = 0;
        std::array<Index, 3> opposite{};
        for (std::size_t k = 0; k < 3; ++k) {
            char& vertex = is_represented[at(triangle[k])];
            owned = static_cast<std::uint8_t>(owned | (vertex ? 0 : 1 << k));
            vertex = 1;
            const MeshEdge& edge = topology.edges[at(topology.triangle_edges[t][k])];
            const bool first = edge.triangle[0] == static_cast<Index>(t);
            owned = static_cast<std::uint8_t>(owned | (first ? 8 << k : 0));
            const Index apex = edge.apex[first ? 1 : 0];
            opposite[k] = apex == k_no_index ? k_no_index : object.first_vertex + apex;
            triangle[k] += object.first_vertex;
        }
        surface.opposite.push_back(opposite);
        surface.triangles.push_back(triangle);
        surface.owned.push_back(owned);
    }
    if (object.id.index == 0) {
        surface.first_of_kind[static_cast<std::size_t>(object.id.kind)] = index;
    }
    surface.objects.push_back(std::move(object));
}

void add_cloth(ContactSurface& surface, const Cloth& cloth, ObjectId id) {
    const FabricParams& fabric = cloth.params.fabric;
    ContactObject object{.name = cloth.name, .id = id};
    object.first_vertex = cloth.first_vertex;
    object.vertex_count = cloth.vertex_count;
    object.thickness = fabric.thickness;
    object.least_thickness = fabric.thickness;
    for (const double finest : finest_thickness(cloth)) {
        surface.self_thickness.push_back(std::min(fabric.thickness, finest));
        object.least_thickness = std::min(object.least_thickness, surface.self_thickness.back());
    }
    object.friction = fabric.friction;
    object.static_friction = fabric.static_friction.value_or(fabric.friction);
    add_mesh(surface, std::move(object), cloth.triangles, cloth.topology);
}

/// Adds what a body carries; its particles belong to the object, too.
void add_body(ContactSurface& surface, const Body& body, ObjectId id, ContactBody carried) {
    ContactObject object{.name = body.name,
                         .id = id,
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

/// Adds an obstacle, whose vertices come next; returns how many they are.
Index add_obstacle(ContactSurface& surface,
                   const Obstacle& obstacle,
                   ObjectId id,
                   Index first_vertex) {
    ContactObject object{.name = obstacle.name, .id = id};
    object.first_vertex = first_vertex;
    object.vertex_count = static_cast<Index>(obstacle.mesh.positions.size());
    object.friction = obstacle.params.friction;
    object.static_friction = obstacle.params.static_friction.value_or(object.friction);
    object.deforms = deforms(obstacle);
    const Index count = object.vertex_count;
    add_mesh(surface, std::move(object), obstacle.mesh.triangles, obstacle.topology);
    return count;
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

bool are_off(const ContactSurface& surface, std::size_t a, std::size_t b, bool cloth_meets_cloth) {
    const auto is_cloth = [&](std::size_t i) {
        return surface.objects[i].id.kind == ObjectKind::Cloth;
    };
    return (a == b && !surface.objects[a].touches_itself) ||
           (!cloth_meets_cloth && is_cloth(a) && is_cloth(b));
}

PairRule rule_between(const ContactObject& a,
                      const ContactObject& b,
                      std::span<const FrictionPair> friction) {
    const bool both_deformable = !a.id.is_obstacle() && !b.id.is_obstacle();
    const double thickness =
        both_deformable ? 0.5 * (a.thickness + b.thickness) : std::max(a.thickness, b.thickness);
    const FrictionCoefficients coefficients = friction_between(a, b, friction);
    return {thickness, coefficients.kinetic, coefficients.sticking};
}

void add_rules(ContactSurface& surface, const ContactParams& contact) {
    for (std::size_t a = 0; a < surface.objects.size(); ++a) {
        for (std::size_t b = 0; b < surface.objects.size(); ++b) {
            surface.rules.push_back(
                rule_between(surface.objects[a], surface.objects[b], contact.friction));
            surface.rules.back().is_off = are_off(surface, a, b, contact.self);
        }
    }
}

/// Takes the masses of embedded vertices and of rigid bodies from their particles.
void place_bodies(ContactSurface& surface) {
    for (ContactBody& body : surface.bodies) {
        parallel_for(at(body.vertex_count), [&](std::size_t i) {
            const std::size_t v = at(body.first_vertex) + i;
            const Embedding& embedding = *surface.embeddings.find(static_cast<Index>(v));
            surface.inverse_mass[v] = 0.0;
            for (std::size_t k = 0; k < 4 && embedding.particles[k] != k_no_index; ++k) {
                surface.inverse_mass[v] += embedding.weights[k] * embedding.weights[k] *
                                           surface.inverse_mass[at(embedding.particles[k])];
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

/// Calls f(v, w) and f(w, v) for each two vertices on the two sides of a joined pair.
template <typename F> void for_each_joined(const World& world, const F& f) {
    for (std::size_t i = 0; i < world.attached_pairs.size(); ++i) {
        if (world.attached_states[i].is_joined == 0) {
            continue;
        }
        const AttachedPair& pair = world.attached_pairs[i];
        for (std::size_t a = 0; a < 6; ++a) {
            for (std::size_t b = 0; b < 6; ++b) {
                if (pair.weights[a] * pair.weights[b] < 0.0) {
                    f(pair.vertices[a], pair.vertices[b]);
                }
            }
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
    const auto start = obstacle_shape(obstacle, time);
    const auto end = obstacle_shape(obstacle, time + dt);
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

std::vector<std::string> thickness_warnings(const World& world, const ContactParams& contact) {
    std::vector<std::string> warnings;
    for (const Cloth& cloth : world.cloths) {
        const std::vector<double> finest = finest_thickness(cloth);
        const double thickness = cloth.params.fabric.thickness;
        const double least = *std::min_element(finest.begin(), finest.end());
        if (contact.enabled && contact.self && least < thickness) {
            warnings.push_back(fmt::format(
                "{}: contact thickness {:g} m is coarse for some of its triangles; down to "
                "{:.3g} m is used there between cloth and cloth",
                cloth.name, thickness, least));
        }
    }
    return warnings;
}

bool ContactSurface::are_joined(Index a, Index b) const {
    return std::binary_search(joined.begin() + joined_begin[at(a)],
                              joined.begin() + joined_begin[at(a) + 1], b);
}

void join_seams(ContactSurface& surface, const World& world) {
    surface.joined_begin.clear();
    surface.joined.clear();
    std::size_t links = 0;
    for_each_joined(world, [&](Index, Index) { ++links; });
    if (links == 0) {
        return;
    }
    surface.joined_begin.assign(surface.start.size() + 1, 0);
    for_each_joined(world, [&](Index v, Index) { ++surface.joined_begin[at(v) + 1]; });
    for (std::size_t v = 0; v < surface.start.size(); ++v) {
        surface.joined_begin[v + 1] += surface.joined_begin[v];
    }
    surface.joined.resize(links);
    // each list is filled through the entry of its end, which starts where the list begins
    for (std::size_t v = surface.start.size(); v > 0; --v) {
        surface.joined_begin[v] = surface.joined_begin[v - 1];
    }
    for_each_joined(world, [&](Index v, Index w) {
        surface.joined[at(surface.joined_begin[at(v) + 1]++)] = w;
    });
    for (std::size_t v = 0; v < surface.start.size(); ++v) {
        const auto begin = surface.joined.begin() + surface.joined_begin[v];
        std::sort(begin, surface.joined.begin() + surface.joined_begin[v + 1]);
    }
}

ContactSurface make_surface(const World& world, const ContactParams& contact) {
    ContactSurface surface;
    surface.embeddings = make_embedding_table(world);
    surface.deformable_vertices = static_cast<Index>(world.vertex_count());
    Index next_vertex = surface.deformable_vertices;
    for (const ObjectId id : objects_of(world)) {
        const std::size_t i = at(id.index);
        switch (id.kind) {
        case ObjectKind::Cloth:
            add_cloth(surface, world.cloths[i], id);
            break;
        case ObjectKind::Solid:
            add_body(surface, world.solids[i].body, id, {});
            break;
        case ObjectKind::Rigid:
            add_body(surface, world.rigids[i].body, id,
                     {.is_rigid = true, .mass = world.rigids[i].params.mass});
            break;
        case ObjectKind::Obstacle:
            next_vertex += add_obstacle(surface, world.obstacles[i], id, next_vertex);
            continue;
        }
        surface.deformable_triangles = static_cast<Index>(surface.triangles.size());
    }
    add_rules(surface, contact);
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
    for (ContactObject& object : surface.objects) {
        if (!object.id.is_obstacle()) {
            continue;
        }
        const Obstacle& obstacle = world.obstacles[at(object.id.index)];
        if (object.deforms) {
            place_deforming(surface, object, obstacle, world.time, dt);
        } else {
            place_rigid(surface, object, obstacle, world.time, dt);
        }
    }
}

} // namespace weft
