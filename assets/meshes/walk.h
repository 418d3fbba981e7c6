#pragma once

#include <Eigen/Geometry>

#include "figure.h"

namespace weft {

/// What moves a figure: a turn of each joint about its place, and a way of the first one.
struct Pose {
    std::array<Eigen::Quaterniond, JointCount> turns;
    Eigen::Vector3d way; ///< m
};

struct WalkParams {
    double duration = 4.0;    ///< s
    double stride_deg = 25.0; ///< of the thighs to either side
    double steps = 1.2;       ///< to and fro a second
    double turn_deg = 90.0;   ///< to the figure's left, in the middle of the walk
    double raise_deg = 30.0;  ///< of the arms, in the second half
};

/// The pose at time t (s): as modelled at t = 0, then a walk that sets out, turns, and comes to a
/// stand with the arms raised.
Pose walk_pose(const WalkParams& params, const Skeleton& skeleton, double t);

} // namespace weft
