#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/pose.h"
#include "state/deformation.h"

#include <memory>
#include <string>

namespace weft {

/// A scripted body that cloth must not enter: a mesh, how it deforms, and the rigid motion on top.
///
/// Vertex i is at time t in pose_at(motion, t) applied about `origin` to its place in the
/// obstacle's own frame: mesh.positions[i], or deformation->at(t)[i] when there is one.
struct Obstacle {
    std::string name;
    ObstacleParams params;
    TriangleMesh mesh; ///< scaled and rotated by the placement, relative to `origin`
    EdgeTopology topology;
    Vec3 origin = Vec3::Zero();                     ///< the placement's translation, m
    std::shared_ptr<const Deformation> deformation; ///< null: rigid
};

/// Whether it changes its shape; else its motion is obstacle_pose() alone.
inline bool deforms(const Obstacle& obstacle) {
    return obstacle.deformation != nullptr;
}

/// Pose that takes the obstacle's own frame to the world at time t (s).
Pose obstacle_pose(const Obstacle& obstacle, double t);

/// Positions of all vertices in the obstacle's own frame at time t, #V; valid while the obstacle
/// is.
Deformation::Positions obstacle_shape(const Obstacle& obstacle, double t);

/// World positions of all vertices at time t, #V long: the one answer to where an obstacle is.
/// During a substep vertices move on the straight line between those at its start and its end.
void obstacle_positions(const Obstacle& obstacle, double t, std::span<Vec3> positions);

/// World positions of the corners of one triangle at time t, the same bits.
std::array<Vec3, 3> obstacle_corners(const Obstacle& obstacle, Index triangle, double t);

} // namespace weft
