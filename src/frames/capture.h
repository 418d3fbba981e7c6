#pragma once

#include "frames/cache.h"
#include "state/world.h"

namespace weft {

/// Takes a world out of the simulation: single precision, with every quantity of k_quantities at
/// the vertices of cloth and solids, rigid bodies, and the obstacles as they stand at the frame's
/// time.
class FrameCapture {
public:
    /// @param frames  of the run, by which the reach of deforming obstacles is found
    FrameCapture(const World& world, double fps, int frames = 1);

    /// The frame that the world stands at.
    Frame capture(const World& world) const;

    const std::vector<RigidShape>& obstacles() const { return obstacles_; }

private:
    double fps_;
    std::vector<RigidShape> obstacles_;
};

} // namespace weft
