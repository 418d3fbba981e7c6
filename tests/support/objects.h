#pragma once

#include "state/world.h"

namespace weft::test {

/// A square cloth of `cells` x `cells` cells and side `size` (m) in the plane y = `height`, centred
/// on the y axis, at rest, 0.2 kg/m^2. Appends it to `world`.
Cloth& add_sheet(World& world, int cells, double size, double height, const FabricParams& fabric);

/// A sphere of 20 * 4^level triangles about `centre`, as an obstacle.
Obstacle& add_sphere(World& world, double radius, const Vec3& centre, int level = 3);

/// A square floor of two triangles at y = `height`.
Obstacle& add_floor(World& world, double size, double height);

/// A closed box of edge lengths `size` about `centre`, as an obstacle.
Obstacle& add_box(World& world, const Vec3& size, const Vec3& centre);

} // namespace weft::test
