#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/pose.h"

#include <memory>
#include <string>

namespace weft {

class Deformation;

/// A scripted body that cloth must not enter: a mesh, how it deforms, and the rigid motion on top.
///
/// At time t vertex i is at pose_at(motion, t), applied about `origin` to its place in the
/// obstacle's own frame: mesh.positions[i], or deformation->at(t)[i] when there is one.
struct Obstacle {
    std::string name;
    ObstacleParams params;
    TriangleMesh mesh; ///< scaled and rotated by the placement, relative to `origin`
    EdgeTopology topology;
    Vec3 origin = Vec3::Zero();                     ///< the placement's translation, m
    std::shared_ptr<const Deformation> deformation; ///< null: rigid
};

/// Whether it changes its shape; if not, obstacle_pose() is its whole motion.
inline bool deforms(const Obstacle& obstacle) {
    return obstacle.deformation != nullptr;
}

/// Pose that takes the obstacle's own frame to the world at time t (s).
Pose obstacle_pose(const Obstacle& obstacle, double t);

/// Positions of all vertices in the obstacle's own frame at time t, #V; valid while the obstacle
/// is.
std::shared_ptr<const std::vector<Vec3>> obstacle_shape(const Obstacle& obstacle, double t);

/// World positions of all vertices at time t, #V long; everything that asks where an obstacle is
/// calls this.
/// During a substep vertices move on the straight line between those at its start and its end.
void obstacle_positions(const Obstacle& obstacle, double t, std::span<Vec3> positions);

/// World positions of the corners of one triangle at time t, the same bits.
std::array<Vec3, 3> obstacle_corners(const Obstacle& obstacle, Index triangle, double t);

} // namespace weft
