#pragma once

#include "scene/params.h"

#include <filesystem>

namespace weft {

/// A scene as the user wrote it, with defaults filled in and fabrics looked up; checked, nothing
/// loaded.
struct Scene {
    std::filesystem::path base_dir; ///< what relative paths in it are relative to
    SceneParams scene;
    ContactParams contact;
    std::vector<ClothParams> cloths;
    std::vector<SolidParams> solids;
    std::vector<RigidParams> rigids;
    std::vector<ObstacleParams> obstacles;
    std::vector<AttachParams> attachments;
    RenderParams render;
};

} // namespace weft
