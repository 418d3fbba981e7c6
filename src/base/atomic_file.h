#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace weft {

/// Writes a file so that it is there whole or not at all: to a temporary name beside it, synced,
/// then renamed over `path`. Creates no folders. Throws Error (Disk) with the path and the system's
/// reason.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);
void write_atomically(const std::filesystem::path& path, std::span<const unsigned char> bytes);

/// The whole file as bytes. Throws Error (Disk) with the path and the system's reason.
std::string read_file(const std::filesystem::path& path);

} // namespace weft
