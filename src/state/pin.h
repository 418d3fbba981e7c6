#pragma once

#include "scene/params.h"
#include "state/obstacle.h"
#include "state/rest_shape.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace weft {

struct Solid;
struct World;

/// A point that moves with an obstacle: barycentric weights on one of its triangles and an offset
/// from there.
struct Anchor {
    Index obstacle = k_no_index; ///< k_no_index: not anchored
    Index triangle = 0;
    Vec3 weights = Vec3::Zero(); ///< sum to 1
    Vec3 offset =
        Vec3::Zero(); ///< m, in the triangle's frame: along its edge, across it, along the normal
};

/// A vertex whose position is given: it stays at `start`, or follows its anchor.
struct Pin {
    Index vertex; ///< World vertex
    Vec3 start;   ///< position at t = 0, m
    Anchor anchor;
    Index group; ///< index into World::pin_groups
};

/// The parameters common to all pins of one `[[cloth.pin]]`.
struct PinGroup {
    std::vector<std::array<double, 4>> move; ///< key frames of the offset: t, x, y, z
    double until = k_forever;                ///< s; the pins hold while t <= until
};

/// The anchor on `obstacle` nearest to `position` at t = 0.
Anchor anchor_to(const Obstacle& obstacle, Index obstacle_index, const Vec3& position);

/// Where a pin holds its vertex at time t.
Vec3 pin_position(const Pin& pin,
                  const PinGroup& group,
                  std::span<const Obstacle> obstacles,
                  double t);

/// The mesh of a cloth, from which pins select vertices.
struct PinnableMesh {
    std::string_view name; ///< the cloth's name, for messages
    std::span<const Triangle> triangles;
    const EdgeTopology& topology;
    std::span<const RestTriangle> rest; ///< #T
    std::span<const Vec3> positions;    ///< #V, m
};

/// Vertices (the cloth's own indices, ascending) that a `[[cloth.pin]]` selects at the start.
/// Throws Error (BadInput) naming cloth, pin and value when an index or loop does not exist, or
/// when nothing is selected.
std::vector<Index>
select_pinned(const PinnableMesh& cloth, const PinParams& pin, std::size_t pin_number);

/// Particles (the solid's own indices, ascending) that a `[[solid.pin]]` selects at the start.
/// Throws Error (BadInput) naming solid and pin when it selects none.
std::vector<Index>
select_pinned(const World& world, const Solid& solid, const PinParams& pin, std::size_t pin_number);

/// Adds the pins of all cloths and solids to world.pins and world.pin_groups. Where two pins select
/// the same vertex the first holds it.
void build_pins(World& world);

/// Moves all pins to where their vertices are now; anchors are found again from there. For t = 0,
/// after a cure of overlap has moved vertices.
void hold_pins_here(World& world);

} // namespace weft
