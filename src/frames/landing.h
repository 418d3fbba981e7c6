#pragma once

#include "frames/frame.h"

#include <span>
#include <vector>

namespace weft {

/// How far each point may fall straight along `down` (unit) until it meets an obstacle of the
/// frame, m; infinite: none lies below. One pass over the triangles for all points.
std::vector<double> fall_to_obstacles(std::span<const Vec3> points,
                                      const Vec3& down,
                                      std::span<const FrameObject> objects);

} // namespace weft
