#pragma once

#include "scene/mesh_file.h"

#include <span>

namespace weft {

/// Indices of the objects that `wanted` names, in the file's order; all when `wanted` is empty. A
/// name is a node's (a node without a surface of its own stands for all below it) or a mesh's.
///
/// Throws Error (BadInput) for a name that the file does not have, naming the nearest it has.
std::vector<std::size_t>
choose_objects(const MeshFile& file, std::span<const std::string> wanted, const std::string& name);

} // namespace weft
