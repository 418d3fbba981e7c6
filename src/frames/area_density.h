#pragma once

#include "frames/frame.h"
#include "scene/params.h"

namespace weft {

/// Mass per area of a cloth, kg/m^2: of its fabric, or of an edge model the mass of the whole
/// object over its area in the first frame.
double area_density(const ClothParams& cloth, const FrameObject& first);

} // namespace weft
