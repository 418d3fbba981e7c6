#include "base/error.h"
#include "state/build_attachments.h"
#include "state/build_cloth.h"
#include "state/build_obstacle.h"
#include "state/build_pins.h"
#include "state/build_rigid.h"
#include "state/build_solid.h"
#include "state/world.h"

namespace weft {

World build_world(const Scene& scene, const std::function<void(const std::string&)>& warn) {
    World world;
    for (const ClothParams& params : scene.cloths) {
        append_cloth(world, params, scene.base_dir, warn);
    }
    for (const SolidParams& params : scene.solids) {
        append_solid(world, params, scene.base_dir, warn);
    }
    if (!scene.rigids.empty() && scene.scene.integrator != Integrator::Euler) {
        fail_input("rigid '{}': needs scene.integrator = \"euler\"", scene.rigids[0].name);
    }
    for (const RigidParams& params : scene.rigids) {
        append_rigid(world, params, scene.base_dir, warn);
    }
    for (const ObstacleParams& params : scene.obstacles) {
        world.obstacles.push_back(build_obstacle(params, scene.base_dir, scene.scene.fps, warn));
    }
    world.previous_positions = world.positions;
    world.previous_velocities = world.velocities;
    build_pins(world);
    build_attachments(world, scene.attachments, warn);
    return world;
}

} // namespace weft
