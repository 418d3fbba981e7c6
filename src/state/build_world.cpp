#include "state/build_world.h"

#include "base/error.h"
#include "scene/pose.h"
#include "state/obstacle.h"
#include "state/pin.h"

#include <algorithm>

namespace weft {

Obstacle& add_obstacle(World& world, const ObstacleParams& params, ImportedObstacle imported) {
    Obstacle obstacle;
    obstacle.name = params.name;
    obstacle.params = params;
    obstacle.origin = params.placement.translate;
    obstacle.mesh = std::move(imported.mesh);
    obstacle.deformation = std::move(imported.deformation);
    if (deforms(obstacle)) {
        obstacle.mesh.positions = *obstacle.deformation->at(0.0);
    } else {
        for (Vec3& x : obstacle.mesh.positions) {
            x = place({Vec3::Zero(), params.placement.rotate_deg, params.placement.scale}, x);
        }
    }
    if (!std::all_of(obstacle.mesh.positions.begin(), obstacle.mesh.positions.end(),
                     [](const Vec3& x) { return x.allFinite(); })) {
        fail_input("{}: its animation gives coordinates that are not finite numbers",
                   params.mesh.file);
    }
    obstacle.topology = build_edges(obstacle.mesh.triangles);
    return world.obstacles.emplace_back(std::move(obstacle));
}

World build_world(const Scene& scene, const Warn& warn) {
    const std::filesystem::path& folder = scene.base_dir;
    World world;
    for (const ClothParams& params : scene.cloths) {
        add_cloth(world, params, import_cloth(params, folder, warn), warn);
    }
    for (const SolidParams& params : scene.solids) {
        add_solid(world, params, import_solid(params, folder, warn));
    }
    if (!scene.rigids.empty() && scene.scene.integrator != Integrator::Euler) {
        fail_input("rigid '{}': needs scene.integrator = \"euler\"", scene.rigids[0].name);
    }
    for (const RigidParams& params : scene.rigids) {
        add_rigid(world, params, import_rigid(params, folder, warn));
    }
    for (const ObstacleParams& params : scene.obstacles) {
        add_obstacle(world, params, import_obstacle(params, folder, scene.scene.fps, warn));
    }
    build_pins(world);
    build_attachments(world, scene.attachments, warn);
    assert_valid(world);
    return world;
}

} // namespace weft
