#include "base/error.h"
#include "scene/format_checks.h"
#include "scene/text_scan.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>

namespace weft {

namespace {

constexpr std::size_t k_header = 84;   ///< 80 bytes of anything, then the number of triangles
constexpr std::size_t k_triangle = 50; ///< normal, three corners, two more bytes

std::size_t announced_triangles(std::string_view bytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

/// Binary files may begin with "solid" too; then zero bytes give them away.
bool is_text(std::string_view bytes) {
    const std::string_view head = bytes.substr(0, 1024);
    return bytes.starts_with("solid") && head.find('\0') == std::string_view::npos;
}

std::string lower(std::string_view word) {
    std::string result(word);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

void check_text(std::string_view bytes, const std::string& name) {
    LineScanner lines(bytes);
    std::string_view line;
    std::vector<std::string_view> words;
    std::size_t facets = 0;
    std::size_t vertices = 0;
    std::string last;
    while (lines.next(line)) {
        split_words(line, words);
        if (words.empty()) {
            continue;
        }
        last = lower(words[0]);
        facets += last == "facet" ? 1 : 0;
        vertices += last == "vertex" ? 1 : 0;
        if (last == "endfacet" && vertices != 3 * facets) {
            fail_input("{}:{}: triangle {} does not have three corners", name, lines.number(),
                       facets - 1);
        }
        if (last == "vertex" && words.size() < 4) {
            fail_input("{}:{}: a corner of triangle {} does not have three coordinates", name,
                       lines.number(), facets - 1);
        }
    }
    if (last != "endsolid") {
        fail_input("{}:{}: truncated: ends in triangle {}, without endsolid", name, lines.number(),
                   facets == 0 ? 0 : facets - 1);
    }
}

} // namespace

void check_stl(std::string_view bytes, const std::string& name) {
    if (is_text(bytes)) {
        check_text(bytes, name);
        return;
    }
    if (bytes.size() < k_header) {
        fail_input("{}: truncated: {} bytes are less than the header of a binary STL ({})", name,
                   bytes.size(), k_header);
    }
    const std::size_t announced = announced_triangles(bytes);
    const std::size_t held = (bytes.size() - k_header) / k_triangle;
    if (held < announced) {
        fail_input("{}: truncated: {} triangles announced, room for {}", name, announced, held);
    }
}

void check_glb(std::string_view bytes, const std::string& name) {
    std::uint32_t length = 0;
    if (bytes.size() < 12 || !bytes.starts_with("glTF")) {
        fail_input("{}: does not begin with the header of a binary glTF", name);
    }
    std::memcpy(&length, bytes.data() + 8, sizeof length);
    if (bytes.size() < length) {
        fail_input("{}: truncated: {} bytes announced, {} found", name, length, bytes.size());
    }
}

} // namespace weft
