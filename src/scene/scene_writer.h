#pragma once

#include "scene/scene.h"

#include <string>

namespace weft {

/// The scene as TOML with every value filled in and fabrics written out, so that reading it from a
/// file in `folder` gives the same scene: paths of meshes are rewritten relative to `folder`, all
/// numbers are in the shortest form that reads back to the same bits.
std::string write_scene(const Scene& scene, const std::filesystem::path& folder);

} // namespace weft
