#include "state/obstacle.h"

#include "base/parallel.h"
#include "state/deformation.h"

#include <cassert>

namespace weft {

Pose obstacle_pose(const Obstacle& obstacle, double t) {
    Pose pose = pose_at(obstacle.params.motion, t);
    pose.translation += obstacle.origin;
    return pose;
}

Deformation::Positions obstacle_shape(const Obstacle& obstacle, double t) {
    if (deforms(obstacle)) {
        return obstacle.deformation->at(t);
    }
    return {Deformation::Positions(), &obstacle.mesh.positions}; // owns nothing
}

void obstacle_positions(const Obstacle& obstacle, double t, std::span<Vec3> positions) {
    assert(positions.size() == obstacle.mesh.positions.size());
    const Pose pose = obstacle_pose(obstacle, t);
    const Deformation::Positions shape = obstacle_shape(obstacle, t);
    assert(shape->size() == positions.size());
    parallel_for(positions.size(), [&](std::size_t i) { positions[i] = pose * (*shape)[i]; });
}

std::array<Vec3, 3> obstacle_corners(const Obstacle& obstacle, Index triangle, double t) {
    const Pose pose = obstacle_pose(obstacle, t);
    const Deformation::Positions shape = obstacle_shape(obstacle, t);
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const Index v = obstacle.mesh.triangles[static_cast<std::size_t>(triangle)][k];
        corners[k] = pose * (*shape)[static_cast<std::size_t>(v)];
    }
    return corners;
}

} // namespace weft
