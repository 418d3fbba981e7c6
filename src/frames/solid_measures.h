#pragma once

#include "state/world.h"

namespace weft {

/// Length over rest length of each edge of a solid's network.
std::vector<double> edge_stretches(const World& world, const Solid& solid);

/// Mean stretch of the edges of each particle (1 where there is none), at the surface vertices that
/// the particles carry, #vertices.
std::vector<double> surface_stretches(const World& world, const Solid& solid);

/// Cells of which any of the tetrahedra at their eight corners, or of the six that carry the
/// surface, has turned inside out or lost its volume.
std::size_t count_inverted_cells(const World& world, const Solid& solid);

/// What a body's surface holds, m^3; an open one is closed by fans about the middles of its rims.
double body_volume(const World& world, const Body& body);

} // namespace weft
