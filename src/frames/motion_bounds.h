#pragma once

#include "frames/frame.h"
#include "geometry/extent.h"
#include "scene/scene.h"

#include <vector>

namespace weft {

/// What a run will probably move in, from its first frame and its scene alone: a camera can be
/// placed before the motion is known.
///
/// Obstacles: exactly, at the frames' times; those that deform by their reach. Cloth: its place at
/// the first frame and ...
/// - what is pinned hangs below its nearest pin by their distance along the mesh, or swings there
///   and somewhat past it, leans with the wind, and goes where the pin goes;
/// - what is free falls for the rest of the run, or until it lies on an obstacle below;
/// - what is on a deforming obstacle, or pinned to it, is taken along;
/// - what reaches over the edge of such an obstacle hangs by its distance from there.
///
/// Solids and rigid bodies: see body_outlook.h.
///
/// @param first    a frame of the run with all its objects, the earliest known
/// @param counts   one a frame object: false leaves it out (a floor), though cloth may land on it
/// Returns an empty extent when nothing that counts has vertices.
Extent predict_motion(const Frame& first, const Scene& scene, const std::vector<bool>& counts);

/// Points of one object; empty when it has none. Points that are not finite are left out.
Extent object_extent(const FrameObject& object);

} // namespace weft
