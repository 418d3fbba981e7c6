#pragma once

#include "app/inspect_start.h"

namespace weft {

/// What `weft inspect` says about a scene file: time, surroundings, each object with the mesh file
/// that it reads, held to what the object needs, and what crosses at the start.
InspectReport describe_scene(const std::filesystem::path& file, const StartInspection& wanted = {});

/// What `weft inspect` says about the folder of a run: how far it came, and its statistics at the
/// last frame with the extremes over all frames.
InspectReport describe_run(const std::filesystem::path& folder);

} // namespace weft
