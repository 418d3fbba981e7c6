#pragma once

#include "geometry/sheet.h"
#include "state/world.h"

#include <functional>

namespace weft {

/// A world of one cloth: the sheet is its rest shape, weft along x, warp along y; `place` says
/// where each of its points is (identity in the plane z = 0 when left out). Nothing moves, nothing
/// is pinned. Of `params` the mesh keys are not used.
World sheet_world(const Sheet& sheet,
                  const ClothParams& params,
                  const std::function<Vec3(const Vec2&)>& place = {});

/// Surroundings without air and gravity, and a solve to round-off.
SceneParams empty_space();

/// A fabric of Young's modulus times thickness (N/m), equal in all directions.
FabricParams isotropic_fabric(double modulus, double poisson);

/// Vertices of the sheet that `is_in` picks.
std::vector<Index> vertices_where(const Sheet& sheet,
                                  const std::function<bool(const Vec2&)>& is_in);

} // namespace weft
