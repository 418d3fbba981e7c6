#pragma once

#include "patch.h"

namespace weft {

/// Signed distance to the mannequin, m, negative inside: 1.75 m tall, y up, soles on y = 0, facing
/// +z, symmetric in x, arms 38° off the trunk. Exact on the surface, first order near it.
double body_field(const Vec3& position);

/// The distance with its slope made 1 within 3 cm of the surface, where it is good to a millimetre.
double body_distance(const Vec3& position);

/// Direction of the upper arm on the side x > 0, from shoulder to elbow, unit.
Vec3 upper_arm_direction();

} // namespace weft
