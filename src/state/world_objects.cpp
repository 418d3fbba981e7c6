#include "state/world_objects.h"

#include <cassert>

namespace weft {

namespace {

/// Calls the function for the kind that an object is of.
template <typename OfCloth, typename OfBody, typename OfObstacle>
auto visit(const World& world,
           Index object,
           const OfCloth& of_cloth,
           const OfBody& of_body,
           const OfObstacle& of_obstacle) {
    assert(object >= 0);
    auto i = static_cast<std::size_t>(object);
    if (i < world.cloths.size()) {
        return of_cloth(world.cloths[i]);
    }
    i -= world.cloths.size();
    if (i < world.solids.size()) {
        return of_body(world.solids[i].body);
    }
    i -= world.solids.size();
    if (i < world.rigids.size()) {
        return of_body(world.rigids[i].body);
    }
    i -= world.rigids.size();
    assert(i < world.obstacles.size());
    return of_obstacle(world.obstacles[i]);
}

} // namespace

std::size_t object_count(const World& world) {
    return world.cloths.size() + world.solids.size() + world.rigids.size() + world.obstacles.size();
}

const std::string& object_name(const World& world, Index object) {
    return *visit(
        world, object, [](const Cloth& cloth) { return &cloth.name; },
        [](const Body& body) { return &body.name; },
        [](const Obstacle& obstacle) { return &obstacle.name; });
}

TriangleMesh object_mesh(const World& world, Index object) {
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

bool is_obstacle(const World& world, Index object) {
    return static_cast<std::size_t>(object) >=
           world.cloths.size() + world.solids.size() + world.rigids.size();
}

} // namespace weft
