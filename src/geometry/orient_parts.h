#pragma once

#include "geometry/triangle_mesh.h"

namespace weft {

/// Turns the triangles of each connected part of a closed mesh that does not cross itself: outward,
/// but those of a part that lies within an odd number of others inward, so that it bounds a cavity.
/// Triangles within a part must be wound alike.
void orient_parts(TriangleMesh& mesh);

} // namespace weft
