#pragma once

#include <filesystem>
#include <string>

namespace weft::test {

/// A file of the checkout, e.g. source_path("assets/scenes/demo.toml").
std::filesystem::path source_path(const std::string& relative);

/// The weft program that this build made.
std::filesystem::path weft_binary();

} // namespace weft::test
