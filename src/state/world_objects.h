#pragma once

#include "state/world.h"

namespace weft {

/// Objects of a world are numbered in this order: cloths, solids, rigid bodies, obstacles.
std::size_t object_count(const World& world);

const std::string& object_name(const World& world, Index object);

/// Positions (m, at the world's time) and triangles of one object.
TriangleMesh object_mesh(const World& world, Index object);

/// Does it move by forces?
bool is_obstacle(const World& world, Index object);

} // namespace weft
