#include "state/obstacle.h"

#include "base/parallel.h"

#include <cassert>

namespace weft {

Pose obstacle_pose(const Obstacle& obstacle, double t) {
    Pose pose = pose_at(obstacle.params.motion, t);
    pose.translation += obstacle.origin;
    return pose;
}

void obstacle_positions(const Obstacle& obstacle, double t, std::span<Vec3> positions) {
    assert(positions.size() == obstacle.mesh.positions.size());
    const Pose pose = obstacle_pose(obstacle, t);
    parallel_for(positions.size(),
                 [&](std::size_t i) { positions[i] = pose * obstacle.mesh.positions[i]; });
}

} // namespace weft
