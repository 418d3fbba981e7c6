#pragma once

#include <filesystem>

namespace weft {

/// Reads the meshes as written, prints what they are and how they lie to each other, and returns
/// whether all of it is as README.md promises.
bool check_meshes(const std::filesystem::path& folder);

} // namespace weft
