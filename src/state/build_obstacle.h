#pragma once

#include "scene/scene.h"
#include "state/obstacle.h"

#include <filesystem>
#include <functional>

namespace weft {

/// Loads the mesh of an obstacle with what deforms it: an animation of its file, numbered files, or
/// a point cache. A deforming obstacle's mesh stands as at t = 0. Every file is read once, so that
/// what is wrong with one is told before the run.
///
/// @param fps   of the scene, 1/s: of sequences and caches that do not say otherwise
/// @param warn  receives one line each
/// Throws Error (BadInput) naming the file.
Obstacle build_obstacle(const ObstacleParams& params,
                        const std::filesystem::path& base_dir,
                        double fps,
                        const std::function<void(const std::string&)>& warn);

} // namespace weft
