#include "state/world_objects.h"

#include <cassert>

namespace weft {

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
