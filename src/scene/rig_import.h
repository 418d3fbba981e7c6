#pragma once

#include "scene/rig.h"

#include <span>

struct aiScene;

namespace weft {

/// Where an object of a mesh file comes from.
struct ObjectOrigin {
    Index node;    ///< by the walk from the root, parents first
    unsigned mesh; ///< in aiScene::mMeshes
};

/// Takes hierarchy, bones, morph targets and animations out of assimp's scene. What is damaged is
/// left out: bones of nodes that are not there, weights of vertices that are not there or that are
/// not finite, keys out of order.
///
/// @param undo_root  goes before the root's transform (FileAxes)
/// @param origins    one an object of the file
Rig read_rig(const aiScene& scene,
             const Eigen::Matrix4d& undo_root,
             std::span<const ObjectOrigin> origins);

} // namespace weft
