#pragma once

#include "state/world.h"

namespace weft {

/// Vertices (of the cloth alone, ascending) that a `[[cloth.pin]]` selects at the start.
/// Throws Error (BadInput) naming cloth, pin and value when an index or loop does not exist, or
/// when nothing is selected.
std::vector<Index> select_pinned(const Cloth& cloth,
                                 const PinParams& pin,
                                 std::size_t pin_number,
                                 std::span<const Vec3> positions);

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
