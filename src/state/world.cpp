#include "state/world.h"

#include "base/hash.h"

#include <fmt/core.h>

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

void carry(const World& world, std::span<Vec3> values) {
    for_each_body(world, [&](const Body& body) { carry(body, values); });
}

std::vector<Index> adaptations_of(const World& world) {
    std::vector<Index> adaptations;
    for (const Cloth& cloth : world.cloths) {
        adaptations.push_back(cloth.refinement.adaptations);
    }
    return adaptations;
}

std::string check(const World& world) {
    const std::size_t count = world.vertex_count();
    if (world.velocities.size() != count || world.masses.size() != count ||
        world.previous_positions.size() != count || world.previous_velocities.size() != count) {
        return "arrays of vertices have unequal lengths";
    }
    std::vector<char> is_carried(count, 0);
    for_each_body(world, [&](const Body& body) {
        std::fill_n(is_carried.begin() + body.first_vertex, body.vertex_count, 1);
    });
    for (std::size_t i = 0; i < count; ++i) {
        if (is_carried[i] != 0 ? world.masses[i] != 0.0 : !(world.masses[i] > 0.0)) {
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

} // namespace weft
