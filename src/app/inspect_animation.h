#pragma once

#include "app/summary_lines.h"
#include "scene/params.h"
#include "scene/rig.h"

#include <filesystem>
#include <span>

namespace weft {

/// What moves in a mesh file, a row an animation: name, duration, nodes, bones, morph targets.
///
/// @param chosen  objects of the file that are looked at
void describe_animations(const Rig& rig, std::span<const std::size_t> chosen, SummaryLines& sheet);

/// How the shape of an obstacle changes during a scene, when it does: loads it as a run does.
///
/// Throws Error (BadInput) as build_obstacle() does.
void describe_deformation(const ObstacleParams& obstacle,
                          const std::filesystem::path& base_dir,
                          const SceneParams& scene,
                          SummaryLines& sheet);

} // namespace weft
