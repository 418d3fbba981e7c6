#pragma once

#include "patch.h"

namespace weft {

/// A sitting rabbit, closed: 0.36 m tall with its ears, feet on y = 0, facing +z, exactly symmetric
/// in x, edges of about 10 mm.
ObjMesh make_rabbit();

} // namespace weft
