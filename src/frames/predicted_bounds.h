#pragma once

#include "frames/predicted_bodies.h"

namespace weft {

/// Predicts the bounds of a run's motion from its first frame and its scene alone, so that a camera
/// can be placed before the motion is known.
///
/// Obstacles are exact at the frames' times; those that deform say how far they reach. The bounds
/// of cloth hold its place at the first frame and follow these rules:
/// - what is pinned hangs below its nearest pin by their distance along the mesh, or swings there
///   and somewhat past it, leans with the wind, and goes where the pin goes;
/// - what is free falls for the rest of the run, or until it lies on an obstacle below;
/// - what is on a deforming obstacle, or pinned to it, is taken along;
/// - what reaches over the edge of an obstacle below hangs by its distance from there.
///
/// Solids and rigid bodies are thrown as they start, see body_bounds().
///
/// @param first   a frame of the run with all its objects, the earliest known
/// @param counts  one a frame object: false leaves it out (a floor), though cloth may land on it
/// Returns an empty extent when nothing that counts has vertices.
Extent predict_bounds(const Frame& first, const Scene& scene, const std::vector<bool>& counts);

} // namespace weft
