#pragma once

#include "render/camera.h"
#include "render/surface.h"

#include <span>

namespace weft {

/// Fills in how much ambient light reaches each vertex of `receivers`, hindered by all `casters`:
/// ambient occlusion on the scale of the body parts and folds, smooth over the surface.
///
/// The scene is drawn flat along k_directions fixed directions, each pixel keeping its nearest and
/// farthest depth, which serves the direction and its opposite; a vertex sees a direction when
/// nothing lies before it. `bounds` is the box that counts (subject_bounds); what lies outside of
/// it neither shades nor is shaded. The result is the same for any thread count.
void add_ambient_occlusion(std::span<Surface* const> receivers,
                           std::span<const Surface* const> casters,
                           const Box3& bounds);

} // namespace weft
