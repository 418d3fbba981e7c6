#pragma once

#include <filesystem>
#include <string>

namespace weft {

/// Looks at a mesh file before assimp does: it exists, is a file, is not empty, and by its ending
/// whatever format_checks.h has for it.
///
/// @param name  the file's name in messages
/// Returns a warning or "". Throws Error (BadInput), one line.
std::string check_mesh_file(const std::filesystem::path& file, const std::string& name);

} // namespace weft
