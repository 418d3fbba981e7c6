#include "base/error.h"
#include "scene/mesh_import.h"
#include "state/build_cloth.h"
#include "state/build_pins.h"
#include "state/shapes.h"
#include "state/world.h"

#include <limits>

namespace weft {

namespace {

TriangleMesh load_obstacle(const ObstacleParams& params,
                           const std::filesystem::path& base_dir,
                           const std::function<void(const std::string&)>& warn) {
    switch (params.shape) {
    case Shape::Sphere:
        return sphere_mesh(params.radius);
    case Shape::Box:
        return box_mesh(params.size);
    case Shape::Plane:
        return plane_mesh(params.size);
    case Shape::Mesh:
        break;
    }
    ImportedMesh imported = import_mesh(base_dir / params.mesh.file, params.mesh, false);
    for (const std::string& line : imported.warnings) {
        warn(fmt::format("obstacle '{}': {}", params.name, line));
    }
    return std::move(imported.mesh);
}

Obstacle build_obstacle(const ObstacleParams& params,
                        const std::filesystem::path& base_dir,
                        const std::function<void(const std::string&)>& warn) {
    Obstacle obstacle;
    obstacle.name = params.name;
    obstacle.params = params;
    obstacle.mesh = load_obstacle(params, base_dir, warn);
    obstacle.origin = params.placement.translate;
    for (Vec3& x : obstacle.mesh.positions) {
        x = place({Vec3::Zero(), params.placement.rotate_deg, params.placement.scale}, x);
    }
    obstacle.topology = build_edges(obstacle.mesh.triangles);
    return obstacle;
}

} // namespace

World build_world(const Scene& scene, const std::function<void(const std::string&)>& warn) {
    World world;
    for (const ClothParams& params : scene.cloths) {
        append_cloth(world, params, scene.base_dir, warn);
    }
    for (const ObstacleParams& params : scene.obstacles) {
        world.obstacles.push_back(build_obstacle(params, scene.base_dir, warn));
    }
    world.previous_positions = world.positions;
    world.previous_velocities = world.velocities;
    build_pins(world);
    return world;
}

} // namespace weft
