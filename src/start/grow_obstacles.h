#pragma once

#include "scene/scene.h"
#include "state/world.h"

#include <functional>
#include <optional>

namespace weft {

struct GrowReport {
    double deepest_inset = 0.0; ///< by which a vertex of an obstacle started shrunken, m
    int rounds = 0;             ///< of untangling what shrinking left crossing
    int substeps = 0;           ///< of the pre-roll
    double greatest_way = 0.0;  ///< that a vertex of cloth moved, m
};

/// Takes cloth out of obstacles by letting these grow into it: each obstacle that cloth crosses is
/// drawn in along its normals as deep as it takes until nothing crosses it (what then still does is
/// untangled), and grows back to its size over a simulated pre-roll in which contact pushes the
/// cloth out. Meanwhile time, the obstacles' own motion, gravity and wind stand still, pins let go
/// and each substep starts from rest: the cloth is carried, not thrown, and nothing falls before
/// the scene begins. Cloth that crosses cloth is untangled first.
///
/// Changes world.positions alone, which may still cross something when contact did not get through.
/// Nothing when should_stop returned true; the world is then to be thrown away.
std::optional<GrowReport>
grow_obstacles(World& world, const Scene& scene, const std::function<bool()>& should_stop);

} // namespace weft
