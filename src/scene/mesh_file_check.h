#pragma once

#include <filesystem>
#include <string>

namespace weft {

/// Looks at a mesh file before assimp does: exists, is a file, is not empty; and where assimp reads
/// a damaged file without a word (or without end), what it would need to notice.
///
/// @param name  the file's name in messages
/// Throws Error (BadInput), one line.
void check_mesh_file(const std::filesystem::path& file, const std::string& name);

} // namespace weft
