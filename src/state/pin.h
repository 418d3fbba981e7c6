#pragma once

#include "scene/params.h"
#include "state/obstacle.h"

#include <vector>

namespace weft {

/// A place on an obstacle's surface that moves with it: weights on a triangle and a height along
/// its normal.
struct Anchor {
    Index obstacle = k_no_index; ///< k_no_index: not anchored
    Index triangle = 0;
    Vec3 weights = Vec3::Zero(); ///< sum to 1
    Vec3 offset =
        Vec3::Zero(); ///< from that point, in the triangle's frame (edge, across, normal), m
};

/// A held vertex.
struct Pin {
    Index vertex; ///< of World
    Vec3 start;   ///< position at t = 0, m
    Anchor anchor;
    Index group; ///< of World::pin_groups
};

/// What the pins of one `[[cloth.pin]]` share.
struct PinGroup {
    std::vector<std::array<double, 4>> move; ///< key frames of the offset: t, x, y, z
    double until = k_forever;                ///< s; the pins hold while t <= until
};

/// The anchor on `obstacle` nearest to `position` at t = 0.
Anchor anchor_to(const Obstacle& obstacle, Index obstacle_index, const Vec3& position);

/// Where a pin holds its vertex at time t.
Vec3 pin_position(const Pin& pin,
                  const PinGroup& group,
                  std::span<const Obstacle> obstacles,
                  double t);

} // namespace weft
