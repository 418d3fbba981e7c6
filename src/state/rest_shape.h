#pragma once

#include "scene/mesh_import.h"
#include "state/cloth.h"

namespace weft {

/// Fills cloth.rest and cloth.material_positions from the placed mesh (rest = mesh: each triangle
/// laid flat as it is, docs/methods.md 1.6) or from its uv (rest = uv: panels in metres).
///
/// Weft follows u and warp follows v where the mesh has uv; else warp follows the mesh's y axis
/// laid onto each triangle (z where the triangle is level). `grain_deg` turns both.
///
/// @param positions  #V, rest positions as placed in the world, m
/// @param corner_uv  #T corner uvs, or empty
/// Throws Error (BadInput) naming the cloth and the triangle when a rest triangle has no area.
void build_rest_shape(Cloth& cloth,
                      std::span<const Vec3> positions,
                      std::span<const std::array<Vec2, 3>> corner_uv);

/// Total area of the rest shape, m^2.
double rest_area(const Cloth& cloth);

} // namespace weft
