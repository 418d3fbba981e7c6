#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// What assimp reads over in a damaged file, looked for in the file itself: it fills the missing
/// end of an OFF or ASCII PLY with nothing, clamps wild indices of OFF, turns half a face of OBJ
/// into a line, and never returns from some short binary PLYs. Each check throws Error (BadInput)
/// in one line naming file, line or element number, and reads no more than it needs for that.
///
/// @param bytes  the whole file
/// @param name   the file's name in messages

/// Returns a warning when vertices are in no face, "" otherwise.
std::string check_obj(std::string_view bytes, const std::string& name);
void check_ply(std::string_view bytes, const std::string& name);
void check_stl(std::string_view bytes, const std::string& name);
void check_off(std::string_view bytes, const std::string& name);
void check_glb(std::string_view bytes, const std::string& name);

/// Looks at a mesh file before assimp does: it exists, is a file, is not empty, and by its ending
/// whatever format_checks.h has for it.
///
/// @param name  the file's name in messages
/// Returns a warning or "". Throws Error (BadInput), one line.
std::string check_mesh_file(const std::filesystem::path& file, const std::string& name);

} // namespace weft
