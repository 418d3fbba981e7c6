#pragma once

#include "scene/mesh_import.h"

#include <span>

namespace weft {

/// The animation of an imported mesh that `wanted` names; the first when it is empty; null when
/// there is none, when it is "none", or when it moves nothing of what was imported.
///
/// @param file  the file's name in messages
/// Throws Error (BadInput) for a name that the file does not have, naming those it has.
const Animation*
choose_animation(const ImportedMesh& mesh, const std::string& wanted, const std::string& file);

/// Whether an animation moves any of the vertices.
bool animates(const Rig& rig, const Animation& animation, std::span<const SourceVertex> vertices);

} // namespace weft
