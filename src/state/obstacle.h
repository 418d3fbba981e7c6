#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/pose.h"

#include <string>

namespace weft {

/// A scripted body that cloth must not enter: a mesh and its rigid motion.
///
/// Vertex i is at time t in pose_at(motion, t) applied about `origin`.
struct Obstacle {
    std::string name;
    ObstacleParams params;
    TriangleMesh mesh; ///< scaled and rotated by the placement, relative to `origin`
    EdgeTopology topology;
    Vec3 origin = Vec3::Zero(); ///< the placement's translation, m
};

/// Pose that takes obstacle.mesh to the world at time t (s).
Pose obstacle_pose(const Obstacle& obstacle, double t);

/// World positions of all vertices at time t, #V long.
void obstacle_positions(const Obstacle& obstacle, double t, std::span<Vec3> positions);

} // namespace weft
