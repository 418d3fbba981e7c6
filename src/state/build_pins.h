#pragma once

#include "state/world.h"

#include <string_view>

namespace weft {

/// The mesh of a cloth, from which pins select vertices.
struct PinnableMesh {
    std::string_view name; ///< of the cloth, for messages
    std::span<const Triangle> triangles;
    const EdgeTopology& topology;
    std::span<const RestTriangle> rest; ///< #T
    std::span<const Vec3> positions;    ///< #V, m
};

/// Vertices (of the cloth alone, ascending) that a `[[cloth.pin]]` selects at the start.
/// Throws Error (BadInput) naming cloth, pin and value when an index or loop does not exist, or
/// when nothing is selected.
std::vector<Index>
select_pinned(const PinnableMesh& cloth, const PinParams& pin, std::size_t pin_number);

/// Particles (of the solid alone, ascending) that a `[[solid.pin]]` selects at the start.
/// Throws Error (BadInput) naming solid and pin when it selects none.
std::vector<Index>
select_pinned(const World& world, const Solid& solid, const PinParams& pin, std::size_t pin_number);

/// Adds the pins of all cloths and solids to world.pins and world.pin_groups. Where two pins select
/// the same vertex the first holds it.
void build_pins(World& world);

/// Lets the pins hold their vertices, and follow what they follow, from where the vertices are now
/// instead of where they were imported. At t = 0 only.
void hold_pins_here(World& world);

} // namespace weft
