#pragma once

#include "frames/frame.h"
#include "scene/scene.h"

#include <vector>

namespace weft {

/// The `[[cloth.pin]]` that holds each vertex of a captured cloth, -1 for free ones; as build_pins
/// chooses them, but by the shape in the frame, so that a box selects rightly at t = 0 alone.
std::vector<int> held_vertices(const FrameObject& cloth, const ClothParams& params);

} // namespace weft
