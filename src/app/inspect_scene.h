#pragma once

#include "app/inspect_mesh.h"
#include "scene/params.h"

namespace weft {

/// What is wanted to be known of a scene's start.
struct StartInspection {
    std::filesystem::path ply; ///< where the crossing triangles go; empty: nowhere
    bool all_pairs = false;    ///< list every crossing pair, not the first few of each two objects
};

/// What `weft inspect` says about a scene file: time, each object with the mesh file
/// that it reads, held to what the object needs, and what crosses at the start.
InspectReport describe_scene(const std::filesystem::path& file, const StartInspection& wanted = {});

} // namespace weft
