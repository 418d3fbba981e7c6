#pragma once

#include "scene/params.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A preset of the library: assets/fabrics/NAME.toml, built into the program.
struct Fabric {
    std::string name;
    std::string description; ///< one line
    FabricParams params;
    std::string_view toml; ///< the file as written, with the source of each number
};

/// All presets, by name.
const std::vector<Fabric>& fabric_library();
std::vector<std::string> fabric_names();

/// The preset of that name, or nullptr.
const Fabric* find_fabric(std::string_view name);

/// A user's own fabric file: the keys of `[cloth.fabric]` at top level, and `description`. Its name
/// is the key `name`, or the file's stem. Throws Error: Disk, or BadInput with line and column.
FabricParams read_fabric_file(const std::filesystem::path& file);

/// One file of assets/fabrics, as text.
struct FabricPresetText {
    std::string_view name; ///< stem of the file
    std::string_view toml;
};

/// All of them by name. The build writes the definition from the files (cmake/WeftFabrics.cmake),
/// so that the program needs none of them where it runs.
std::span<const FabricPresetText> fabric_preset_texts();

} // namespace weft
