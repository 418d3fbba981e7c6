#pragma once

#include "frames/frame.h"
#include "geometry/extent.h"
#include "scene/scene.h"

#include <vector>

namespace weft {

/// What of a solid or a rigid body says how it begins.
struct BodyStart {
    Vec3 velocity = Vec3::Zero(); ///< m/s
    std::vector<PinParams> pins;  ///< of particles; with one it stays where they are
};

/// What a body will probably move in: thrown as it starts, without air, until it comes upon
/// another object below, or to the end of the run; what stops it may give way by a share of its
/// own size unless it is an obstacle.
///
/// @param number  of the body among first.objects
Extent
body_extent(const Frame& first, std::size_t number, const BodyStart& start, const Scene& scene);

} // namespace weft
