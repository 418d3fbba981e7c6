#include "state/obstacle.h"

#include "base/parallel.h"

#include <tbb/task_arena.h>

#include <cassert>
#include <utility>

namespace weft {

Deformation::Deformation(std::size_t vertices, std::uint64_t fingerprint, Evaluate evaluate)
    : vertices_(vertices), fingerprint_(fingerprint), evaluate_(std::move(evaluate)) {}

Deformation::Positions Deformation::at(double t) const {
    const std::lock_guard lock(mutex_);
    for (const Answer& answer : answers_) {
        if (answer.positions && answer.time == t) {
            return answer.positions;
        }
    }
    Answer& answer = answers_[oldest_];
    if (!answer.positions || answer.positions.use_count() > 1) {
        answer.positions = std::make_shared<std::vector<Vec3>>(vertices_);
    }
    const auto positions = std::exchange(answer.positions, nullptr); // none, should this throw
    // Isolated: a thread that waits in here must not take up work that asks for this lock again.
    tbb::this_task_arena::isolate([&] { evaluate_(t, *positions); });
    answer = {t, positions};
    oldest_ = (oldest_ + 1) % answers_.size();
    return positions;
}

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
