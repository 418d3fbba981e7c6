#pragma once

#include "base/eigen.h"
#include "geometry/triangle_mesh.h"
#include "scene/pose.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The vertex positions of a deforming obstacle in its own frame: a function of time alone, so that
/// a run that was stopped and resumed sees the same bits. The last results are kept, as several
/// callers ask for the start and the end of a substep.
class Deformation {
public:
    using Positions = std::shared_ptr<const std::vector<Vec3>>;
    /// Writes the positions (#V, m) at time t (s); must depend on nothing else.
    using Evaluate = std::function<void(double t, std::span<Vec3> positions)>;

    /// @param fingerprint  hash of the files' content: differs where the motion differs
    Deformation(std::size_t vertices, std::uint64_t fingerprint, Evaluate evaluate);

    /// Positions at time t. May be called from several threads.
    Positions at(double t) const;

    std::size_t vertex_count() const { return vertices_; }
    std::uint64_t fingerprint() const { return fingerprint_; }

private:
    struct Answer {
        double time = 0.0;
        std::shared_ptr<std::vector<Vec3>> positions; ///< null: none yet
    };

    std::size_t vertices_;
    std::uint64_t fingerprint_;
    Evaluate evaluate_;
    mutable std::mutex mutex_;
    /// Start, end, and the two of a substep that was cut in half. The oldest makes room.
    mutable std::array<Answer, 4> answers_;
    mutable std::size_t oldest_ = 0;
};

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
