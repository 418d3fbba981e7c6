#include "frames/rigid_shape.h"

#include "base/parallel.h"

namespace weft {

FrameObject pose_shape(const RigidShape& rigid, double t) {
    FrameObject posed = rigid.shape;
    Pose pose = pose_at(rigid.motion, t);
    pose.translation += rigid.origin;
    parallel_for(posed.positions.size(), [&](std::size_t i) {
        posed.positions[i] = (pose * rigid.shape.positions[i].cast<double>()).cast<float>();
    });
    return posed;
}

} // namespace weft
