#pragma once

#include "geometry/triangle_mesh.h"

namespace weft {

/// Pairs of triangles of a mesh that cross, sorted, each with its lower number first. Neighbours
/// count only where they cross beyond the corners that they share. Exact (triangles_cross).
std::vector<std::array<Index, 2>> find_self_crossings(const TriangleMesh& mesh);

} // namespace weft
