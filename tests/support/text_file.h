#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace weft::test {

/// Writes a small file as it is, byte for byte; returns its path.
inline std::filesystem::path write_file(const std::filesystem::path& file,
                                        const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

} // namespace weft::test
