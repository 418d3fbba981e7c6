#pragma once

#include "frames/frame.h"
#include "scene/pose.h"

#include <vector>

namespace weft {

/// An obstacle as it is kept for pictures: its mesh once, in its own frame and in the single
/// precision of the cache, and its motion. A live run and a run read back pose the same numbers by
/// the same code, so that they draw the same bytes.
/// One that deforms has its reach alone here: its positions stand in the cache frame by frame.
struct RigidShape {
    FrameObject shape; ///< name, own positions, triangles
    Vec3 origin;       ///< the placement's translation, m
    std::vector<PoseKey> motion;
};

/// The obstacle at time t (s).
FrameObject pose_shape(const RigidShape& rigid, double t);

} // namespace weft
