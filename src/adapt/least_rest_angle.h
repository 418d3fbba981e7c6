#pragma once

#include "state/cloth.h"

namespace weft {

/// Least angle of a cloth's rest triangles, rad; pi / 3 without triangles.
double least_rest_angle(const Cloth& cloth);

/// Least angle (rad) of all rest triangles that refinement up to `levels` can bring about, whatever
/// is refined and removed and in what order, and whatever flips have to wait: what the imported
/// mesh itself allows. Of equilateral triangles 30 degrees, of right isosceles ones atan(1/3) =
/// 18.43, of others about half of their own least angle; locked edges and frozen triangles count.
///
/// A triangle of any such mesh depends on the vertices that it rests on alone, so that all of them
/// occur while the whole mesh is refined. That is done to a copy: time and memory are 3^levels
/// times those of the imported mesh.
/// @param cloth   adaptive (make_refinement), in any state
/// @param levels  0..k_most_levels
double least_refined_angle(const Cloth& cloth, Index levels);

} // namespace weft
