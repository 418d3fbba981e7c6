#pragma once

#include "patch.h"

namespace weft {

/// A round plate with a hole in its middle, closed: 0.54 m across, 2 cm thick about y = 0, the hole
/// 8 cm wide; its lip is round, its rim an edge.
ObjMesh make_plate_with_hole();

} // namespace weft
