#pragma once

#include "collide/contact_report.h"

#include <span>
#include <string>

namespace weft {

/// Text of a PLY of the triangles that cross at world.time, as faces (cloth red, obstacles blue,
/// with the numbers of object and triangle as properties), and the curves in which they cross, as
/// edges (yellow). MeshLab and Blender show it.
std::string encode_crossings(const World& world, std::span<const UnresolvedPair> pairs);

} // namespace weft
