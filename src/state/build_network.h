#pragma once

#include "state/cloth.h"

namespace weft {

/// The edges that hold a cloth of an edge model together, by its rest shape:
///
/// - sides: the edges of the mesh, but for those that cut a quad of the import in two;
/// - diagonals: both of each quad, with `spring.shear` times K; none where that is 0;
/// - bending edges, with K = `spring.bend`: of a grid from each vertex to the second next in its
///   row and column, of a mesh between the apexes across each side with two triangles, as far
///   apart as they are when these lie flat; none where `bend` is 0, and none where another edge is.
///
/// Of stvk_triangle the bending edges alone. With `spring.calibrate` K of sides and diagonals is
/// that of calibrate_network().
///
/// @param polygons  #T: triangles of one polygon of the import have the same number
EdgeNetwork cloth_network(const Cloth& cloth, std::span<const Index> polygons);

} // namespace weft
