#pragma once

#include <span>
#include <string_view>

namespace weft {

/// One file of assets/fabrics, as text.
struct FabricPresetText {
    std::string_view name; ///< stem of the file
    std::string_view toml;
};

/// All of them by name. The build writes the definition from the files (cmake/WeftFabrics.cmake),
/// so that the program needs none of them where it runs.
std::span<const FabricPresetText> fabric_preset_texts();

} // namespace weft
