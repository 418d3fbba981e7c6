#include "scene/mesh_file_check.h"

#include "base/error.h"

#include <fstream>

namespace weft {

void check_mesh_file(const std::filesystem::path& file, const std::string& name) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) {
        fail_input("{}: no such file", name);
    }
    if (std::filesystem::is_directory(status)) {
        fail_input("{}: is a folder, not a mesh file", name);
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        fail_input("{}: cannot be opened for reading", name);
    }
    if (stream.peek() == std::ifstream::traits_type::eof()) {
        fail_input("{}: is empty", name);
    }
}

} // namespace weft
