#pragma once

#include "state/world.h"

#include <filesystem>
#include <functional>

namespace weft {

/// Edges of an imported surface longer than this many spacings are halved, so that the surface
/// bends with the particles that carry it. Larger: corners of flat faces cut through the particles
/// when these are dented; smaller: more triangles in contact than the particles can tell apart.
inline constexpr double k_longest_edge = 1.5;

/// Fills a solid with particles and adds it, at the end of the world's arrays: its carried surface
/// vertices, then its particles. Its surface is the box's outside or the imported mesh with long
/// edges halved; its edges all have the stiffness K, diagonals `shear` times that.
///
/// Throws Error (BadInput) naming solid, file and place when the mesh is open (unless
/// `fill = "winding"`) or crosses itself, when nothing is inside, or when the lattice would have
/// more than k_most_cells cells.
void append_solid(World& world,
                  const SolidParams& params,
                  const std::filesystem::path& base_dir,
                  const std::function<void(const std::string&)>& warn);

/// Cells of a lattice, inside or not; more is a slip in the spacing.
inline constexpr double k_most_cells = 1e8;

} // namespace weft
