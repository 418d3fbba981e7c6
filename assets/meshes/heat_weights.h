#pragma once

#include "figure.h"

namespace weft {

/// Weights of the joints on each vertex, #V x #joints, rows sum to 1: heat in balance on the
/// surface, where each vertex is held at its nearest bone's one with a strength of 1 / distance^2.
/// Smooth over about the thickness of the limb.
/// Source: Baran and Popovic 2007, "Automatic rigging and animation of 3D characters", section 4;
/// nearest is meant to the flesh around a bone, instead of the visibility test.
Eigen::MatrixXd heat_weights(const Figure& figure, const Skeleton& skeleton);

} // namespace weft
