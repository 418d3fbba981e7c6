#include "scene/mesh_file_check.h"

#include "base/error.h"
#include "scene/format_checks.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

namespace weft {

namespace {

std::string lower_extension(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string
check_format(std::ifstream& stream, const std::string& extension, const std::string& name) {
    const bool is_checked = extension == ".obj" || extension == ".ply" || extension == ".stl" ||
                            extension == ".off" || extension == ".glb";
    if (!is_checked) {
        return "";
    }
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (extension == ".obj") {
        return check_obj(bytes, name);
    }
    if (extension == ".ply") {
        check_ply(bytes, name);
    } else if (extension == ".stl") {
        check_stl(bytes, name);
    } else if (extension == ".off") {
        check_off(bytes, name);
    } else {
        check_glb(bytes, name);
    }
    return "";
}

} // namespace

std::string check_mesh_file(const std::filesystem::path& file, const std::string& name) {
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
    return check_format(stream, lower_extension(file), name);
}

} // namespace weft
