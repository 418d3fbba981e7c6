#include "state/world.h"

#include "base/debug_build.h"
#include "base/hash.h"

#include <fmt/core.h>

#include <cassert>
#include <cstdio>

namespace weft {

namespace {

std::string check_finite(std::span<const Vec3> values, std::string_view what) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i].allFinite()) {
            return fmt::format("{} of vertex {} is not finite", what, i);
        }
    }
    return "";
}

std::string check_cloth(const World& world, const Cloth& cloth) {
    if (cloth.first_vertex < 0 ||
        static_cast<std::size_t>(cloth.first_vertex + cloth.vertex_count) > world.vertex_count()) {
        return fmt::format("cloth '{}' reaches past the world's vertices", cloth.name);
    }
    if (cloth.rest.size() != cloth.triangles.size() ||
        cloth.material_positions.size() != static_cast<std::size_t>(cloth.vertex_count)) {
        return fmt::format("cloth '{}' has arrays of unequal length", cloth.name);
    }
    for (const Triangle& t : cloth.triangles) {
        for (const Index v : t) {
            if (v < 0 || v >= cloth.vertex_count) {
                return fmt::format("cloth '{}' has a triangle with vertex {}", cloth.name, v);
            }
        }
    }
    return "";
}

/// Faults of the indices that bodies, pins and attached pairs have.
std::string check_indices(const World& world) {
    const auto count = static_cast<Index>(world.vertex_count());
    std::string problem;
    for_each_body(world, [&](const Body& body) {
        if (body.first_vertex < 0 || body.first_vertex + body.vertex_count > count ||
            body.first_particle < 0 || body.first_particle + body.particle_count > count) {
            problem = fmt::format("body '{}' reaches past the world's vertices", body.name);
        }
    });
    for (std::size_t i = 0; i < world.pins.size() && problem.empty(); ++i) {
        const Index v = world.pins[i].vertex;
        if (v < 0 || v >= count) {
            problem = fmt::format("pin {} has vertex {}", i, v);
        }
    }
    for (std::size_t i = 0; i < world.attached_pairs.size() && problem.empty(); ++i) {
        for (const Index v : world.attached_pairs[i].vertices) {
            if (v < k_no_index || v >= count) {
                problem = fmt::format("attached pair {} has vertex {}", i, v);
            }
        }
    }
    return problem;
}

void add_vectors(Hash& hash, const std::vector<Vec3>& values) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    hash.add(std::span<const Vec3>(values));
}

} // namespace

std::size_t World::triangle_count() const {
    std::size_t count = 0;
    for (const Cloth& cloth : cloths) {
        count += cloth.triangles.size();
    }
    for_each_body(*this, [&](const Body& body) { count += body.triangles.size(); });
    return count;
}

std::span<const Vec3> World::positions_of(const Cloth& cloth) const {
    return std::span(positions).subspan(static_cast<std::size_t>(cloth.first_vertex),
                                        static_cast<std::size_t>(cloth.vertex_count));
}

std::span<const Vec3> World::velocities_of(const Cloth& cloth) const {
    return std::span(velocities)
        .subspan(static_cast<std::size_t>(cloth.first_vertex),
                 static_cast<std::size_t>(cloth.vertex_count));
}

void interpolate_embedded(const World& world, std::span<Vec3> values) {
    for_each_body(world, [&](const Body& body) { interpolate_embedded(body, values); });
}

void extend_history(World& world) {
    const auto extend = [](std::vector<Vec3>& previous, const std::vector<Vec3>& present) {
        previous.insert(previous.end(), present.begin() + static_cast<long>(previous.size()),
                        present.end());
    };
    extend(world.previous_positions, world.positions);
    extend(world.previous_velocities, world.velocities);
}

std::vector<Index> mesh_revisions(const World& world) {
    std::vector<Index> revisions;
    for (const Cloth& cloth : world.cloths) {
        revisions.push_back(cloth.refinement.adaptations);
    }
    return revisions;
}

std::string check(const World& world) {
    const std::size_t count = world.vertex_count();
    if (world.velocities.size() != count || world.masses.size() != count ||
        world.previous_positions.size() != count || world.previous_velocities.size() != count) {
        return "arrays of vertices have unequal lengths";
    }
    if (auto problem = check_indices(world); !problem.empty()) {
        return problem;
    }
    std::vector<char> is_embedded(count, 0);
    for_each_body(world, [&](const Body& body) {
        std::fill_n(is_embedded.begin() + body.first_vertex, body.vertex_count, 1);
    });
    for (std::size_t i = 0; i < count; ++i) {
        if (is_embedded[i] != 0 ? world.masses[i] != 0.0 : !(world.masses[i] > 0.0)) {
            return fmt::format("mass of vertex {} is {}", i, world.masses[i]);
        }
    }
    if (world.attached_states.size() != world.attached_pairs.size()) {
        return "arrays of attached pairs have unequal lengths";
    }
    for (const Cloth& cloth : world.cloths) {
        if (auto problem = check_cloth(world, cloth); !problem.empty()) {
            return problem;
        }
    }
    if (auto problem = check_finite(world.positions, "position"); !problem.empty()) {
        return problem;
    }
    return check_finite(world.velocities, "velocity");
}

void assert_valid(const World& world) {
    if constexpr (k_is_debug_build) {
        const std::string fault = check(world);
        if (!fault.empty()) {
            fmt::print(stderr, "{}\n", fault);
        }
        assert(fault.empty());
    }
}

Vec3 linear_momentum(const World& world) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += world.masses[i] * world.velocities[i];
    }
    return sum;
}

Vec3 angular_momentum(const World& world) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += world.masses[i] * world.positions[i].cross(world.velocities[i]);
    }
    return sum;
}

double speed_sum(const World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += world.masses[i] * world.velocities[i].norm();
    }
    return sum;
}

double kinetic_energy(const World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += 0.5 * world.masses[i] * world.velocities[i].squaredNorm();
    }
    return sum;
}

std::uint64_t state_hash(const World& world) {
    Hash hash;
    const std::array<double, 2> times{world.time, world.history_dt};
    hash.add(std::span<const double>(times));
    add_vectors(hash, world.positions);
    add_vectors(hash, world.velocities);
    add_vectors(hash, world.previous_positions);
    add_vectors(hash, world.previous_velocities);
    hash.add(std::span<const AttachedState>(world.attached_states));
    hash.add(std::span<const FrictionHistory>(world.friction_history));
    return hash.value();
}

namespace {

/// Calls the function for the kind that an object is of.
template <typename OfCloth, typename OfBody, typename OfObstacle>
auto visit(const World& world,
           ObjectId object,
           const OfCloth& of_cloth,
           const OfBody& of_body,
           const OfObstacle& of_obstacle) {
    const std::size_t i = at(object.index);
    switch (object.kind) {
    case ObjectKind::Cloth:
        assert(i < world.cloths.size());
        return of_cloth(world.cloths[i]);
    case ObjectKind::Solid:
        assert(i < world.solids.size());
        return of_body(world.solids[i].body);
    case ObjectKind::Rigid:
        assert(i < world.rigids.size());
        return of_body(world.rigids[i].body);
    case ObjectKind::Obstacle:
        break;
    }
    assert(i < world.obstacles.size());
    return of_obstacle(world.obstacles[i]);
}

} // namespace

std::vector<ObjectId> objects_of(const World& world) {
    std::vector<ObjectId> objects;
    const auto add = [&](ObjectKind kind, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            objects.push_back({kind, static_cast<Index>(i)});
        }
    };
    add(ObjectKind::Cloth, world.cloths.size());
    add(ObjectKind::Solid, world.solids.size());
    add(ObjectKind::Rigid, world.rigids.size());
    add(ObjectKind::Obstacle, world.obstacles.size());
    return objects;
}

const std::string& object_name(const World& world, ObjectId object) {
    return *visit(
        world, object, [](const Cloth& cloth) { return &cloth.name; },
        [](const Body& body) { return &body.name; },
        [](const Obstacle& obstacle) { return &obstacle.name; });
}

TriangleMesh object_mesh(const World& world, ObjectId object) {
    return visit(
        world, object,
        [&](const Cloth& cloth) {
            const auto x = world.positions_of(cloth);
            return TriangleMesh{{x.begin(), x.end()}, cloth.triangles};
        },
        [&](const Body& body) {
            const auto begin = world.positions.begin() + body.first_vertex;
            return TriangleMesh{{begin, begin + body.vertex_count}, body.triangles};
        },
        [&](const Obstacle& obstacle) {
            TriangleMesh mesh = obstacle.mesh;
            obstacle_positions(obstacle, world.time, mesh.positions);
            return mesh;
        });
}

} // namespace weft
