#pragma once

#include <filesystem>
#include <string>

namespace weft::test {

/// A file of the checkout, e.g. source_path("assets/scenes/demo.toml").
inline std::filesystem::path source_path(const std::string& relative) {
    return std::filesystem::path(WEFT_SOURCE_DIR) / relative;
}

/// The weft program that this build made.
inline std::filesystem::path weft_binary() {
    return WEFT_BINARY;
}

} // namespace weft::test
