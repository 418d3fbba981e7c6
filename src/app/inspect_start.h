#pragma once

#include "app/inspect_mesh.h"
#include "scene/scene.h"

namespace weft {

/// What is wanted to be known of a scene's start.
struct StartInspection {
    std::filesystem::path ply; ///< where the crossing triangles go; empty: nowhere
    bool all_pairs = false;    ///< list every crossing pair, not the first few of each two objects
};

/// The pairs of triangles that cross at t = 0, by object and triangle number, with counts; refused
/// as a simulation would. Builds the scene's world: throws Error where that does.
InspectReport describe_start(const Scene& scene, const StartInspection& wanted);

} // namespace weft
