#pragma once

#include "geometry/triangle_mesh.h"

namespace weft {

/// The same surface with no edge longer than `longest` (m): longer ones are halved, with all
/// triangles beside them, until none is left. Vertices keep their numbers, new ones follow.
TriangleMesh split_long_edges(TriangleMesh mesh, double longest);

} // namespace weft
