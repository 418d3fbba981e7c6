#pragma once

#include "geometry/shapes.h"
#include "state/cloth.h"

#include <functional>

namespace weft::test {

/// A cloth at rest in the sheet's plane, weft along x.
Cloth cloth_of(const Sheet& sheet,
               const FabricParams& fabric = {},
               BendModel bend_model = BendModel::MidEdge);

/// Positions (m) of the sheet's points under a map of the plane into space.
std::vector<Vec3> placed(const Sheet& sheet, const std::function<Vec3(const Vec2&)>& map);

} // namespace weft::test
