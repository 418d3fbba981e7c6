#pragma once

#include "app/inspect_mesh.h"

namespace weft {

/// What `weft inspect` says about the folder of a run: how far it came, and its statistics at the
/// last frame with the extremes over all frames.
InspectReport describe_run(const std::filesystem::path& folder);

} // namespace weft
