#include "frames/ply.h"

#include "base/error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cstring>

namespace weft {

static_assert(std::endian::native == std::endian::little, "PLY rows are copied as they lie");

namespace {

constexpr std::size_t k_face_bytes = 1 + 3 * sizeof(std::int32_t);
constexpr std::string_view k_list = "property list uchar int vertex_indices";

/// What the header says.
struct Header {
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::vector<std::string> properties; ///< names of a vertex's values, all float
    std::size_t bytes = 0;               ///< length of the header itself
};

void append(std::string& out, const void* data, std::size_t count) {
    out.append(static_cast<const char*>(data), count);
}

std::string header_text(const FrameObject& object, std::string_view comment) {
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\ncomment {}\n"
                                   "element vertex {}\nproperty float x\nproperty float y\n"
                                   "property float z\n",
                                   comment, object.positions.size());
    if (!object.material_positions.empty()) {
        text += "property float u\nproperty float v\n";
    }
    for (std::size_t q = 0; q < k_quantities.size(); ++q) {
        if (!object.values[q].empty()) {
            text += fmt::format("property float {}\n", k_quantities[q].name);
        }
    }
    return text + fmt::format("element face {}\n{}\nend_header\n", object.triangles.size(), k_list);
}

/// The number that ends a line such as "element vertex 12".
std::size_t count_of(std::string_view line, std::string_view before, const std::string& place) {
    const std::string_view digits = line.substr(before.size());
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    if (error != std::errc() || end != digits.data() + digits.size() || count > 0x7fffffff) {
        fail_disk("{}: '{}': a count must end this line of the PLY header", place, line);
    }
    return count;
}

Header read_header(std::string_view bytes, const std::string& place) {
    Header header;
    int line_number = 0;
    for (std::size_t begin = 0; begin < bytes.size();) {
        const std::size_t end = bytes.find('\n', begin);
        if (end == std::string_view::npos) {
            break;
        }
        const std::string_view line = bytes.substr(begin, end - begin);
        begin = end + 1;
        ++line_number;
        if (line_number == 1 && line != "ply") {
            break;
        }
        if (line == "end_header") {
            header.bytes = begin;
            return header;
        }
        if (line.starts_with("element vertex ")) {
            header.vertices = count_of(line, "element vertex ", place);
        } else if (line.starts_with("element face ")) {
            header.faces = count_of(line, "element face ", place);
        } else if (line.starts_with("property float ")) {
            header.properties.emplace_back(line.substr(std::strlen("property float ")));
        } else if (line_number > 1 && line != k_list && !line.starts_with("comment") &&
                   line != "format binary_little_endian 1.0") {
            fail_disk("{}:{}: '{}': not a PLY that weft wrote", place, line_number, line);
        }
    }
    fail_disk("{}: no PLY header: must begin with 'ply' and close it with 'end_header'", place);
}

/// Where the value of one property goes: a pointer to the vertex's own float, or null.
float* slot(FrameObject& object, std::string_view property, std::size_t vertex) {
    if (property.size() == 1 && property[0] >= 'x' && property[0] <= 'z') {
        return &object.positions[vertex][property[0] - 'x'];
    }
    if (property == "u" || property == "v") {
        object.material_positions.resize(object.positions.size());
        return &object.material_positions[vertex][property == "v"];
    }
    const int quantity = find_quantity(property);
    if (quantity < 0) {
        return nullptr;
    }
    auto& values = object.values[static_cast<std::size_t>(quantity)];
    values.resize(object.positions.size());
    return &values[vertex];
}

/// Every vertex must have x y z, and both of u v or neither: what is left out would stay unset.
void check_properties(const Header& header, const std::string& place) {
    const auto has = [&](std::string_view name) {
        return std::count(header.properties.begin(), header.properties.end(), name) == 1;
    };
    if (!has("x") || !has("y") || !has("z") || has("u") != has("v")) {
        fail_disk("{}: vertices must have x, y and z, cloth u and v too, each once", place);
    }
}

void read_vertices(FrameObject& object,
                   const Header& header,
                   const char* data,
                   const std::string& place) {
    object.positions.resize(header.vertices);
    const std::size_t stride = header.properties.size() * sizeof(float);
    for (std::size_t i = 0; i < header.vertices; ++i) {
        for (std::size_t p = 0; p < header.properties.size(); ++p) {
            if (float* value = slot(object, header.properties[p], i)) {
                std::memcpy(value, data + i * stride + p * sizeof(float), sizeof(float));
            }
        }
        if (!object.positions[i].allFinite()) {
            fail_disk("{}: vertex {}: its coordinates are not finite", place, i);
        }
    }
}

void read_faces(FrameObject& object,
                const Header& header,
                const char* data,
                const std::string& place) {
    object.triangles.resize(header.faces);
    for (std::size_t f = 0; f < header.faces; ++f) {
        const char* row = data + f * k_face_bytes;
        std::memcpy(object.triangles[f].data(), row + 1, k_face_bytes - 1);
        if (row[0] != 3) {
            fail_disk("{}: face {}: {} corners: must be 3", place, f, static_cast<int>(row[0]));
        }
        for (const Index v : object.triangles[f]) {
            if (v < 0 || static_cast<std::size_t>(v) >= header.vertices) {
                fail_disk("{}: face {}: vertex {}: must be 0 to {}", place, f, v,
                          static_cast<long long>(header.vertices) - 1);
            }
        }
    }
}

} // namespace

std::string encode_ply(const FrameObject& object, std::string_view comment) {
    assert(comment.find('\n') == std::string_view::npos);
    std::string out = header_text(object, comment);
    out.reserve(out.size() + object.positions.size() * 48 + object.triangles.size() * k_face_bytes);
    for (std::size_t i = 0; i < object.positions.size(); ++i) {
        append(out, object.positions[i].data(), 3 * sizeof(float));
        if (!object.material_positions.empty()) {
            append(out, object.material_positions[i].data(), 2 * sizeof(float));
        }
        for (const auto& values : object.values) {
            assert(values.empty() || values.size() == object.positions.size());
            if (!values.empty()) {
                append(out, &values[i], sizeof(float));
            }
        }
    }
    for (const Triangle& triangle : object.triangles) {
        out.push_back(3);
        append(out, triangle.data(), k_face_bytes - 1);
    }
    return out;
}

FrameObject decode_ply(std::string_view bytes, const std::string& place) {
    const Header header = read_header(bytes, place);
    check_properties(header, place);
    const std::size_t vertex_bytes = header.vertices * header.properties.size() * sizeof(float);
    const std::size_t expected = header.bytes + vertex_bytes + header.faces * k_face_bytes;
    if (bytes.size() != expected) {
        fail_disk("{}: {} bytes: its header promises {}", place, bytes.size(), expected);
    }
    FrameObject object;
    read_vertices(object, header, bytes.data() + header.bytes, place);
    read_faces(object, header, bytes.data() + header.bytes + vertex_bytes, place);
    object.kind = object.material_positions.empty() ? ObjectKind::Obstacle : ObjectKind::Cloth;
    return object;
}

} // namespace weft
