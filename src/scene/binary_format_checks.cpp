#include "base/error.h"
#include "scene/format_checks.h"
#include "scene/text_scan.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>

namespace weft {
namespace {

enum class Encoding { Text, LittleEndian, BigEndian };

struct Type {
    std::size_t bytes = 0; ///< 0: no such type
    bool is_real = false;
    bool is_signed = false;
};

struct Property {
    Type count; ///< type of the number before a list; bytes = 0: not a list
    Type value;
    bool is_corner_list = false;
};

struct Element {
    std::string name;
    long long count = 0;
    std::vector<Property> properties;
};

Type type_of(std::string_view word) {
    const auto is = [&](std::string_view a, std::string_view b) { return word == a || word == b; };
    if (is("char", "int8")) {
        return {1, false, true};
    }
    if (is("uchar", "uint8")) {
        return {1, false, false};
    }
    if (is("short", "int16")) {
        return {2, false, true};
    }
    if (is("ushort", "uint16")) {
        return {2, false, false};
    }
    if (is("int", "int32")) {
        return {4, false, true};
    }
    if (is("uint", "uint32")) {
        return {4, false, false};
    }
    if (is("float", "float32")) {
        return {4, true, true};
    }
    if (is("double", "float64")) {
        return {8, true, true};
    }
    return {};
}

/// What the body must hold, as the header says.
class Header {
public:
    Header(std::string_view bytes, const std::string& name) : lines_(bytes), name_(name) {
        std::string_view line;
        std::vector<std::string_view> words;
        bool ended = false;
        while (!ended && lines_.next(line)) {
            split_words(line, words);
            if (words.empty()) {
                continue;
            }
            ended = words[0] == "end_header";
            if (words[0] == "format" && words.size() > 1) {
                encoding = words[1] == "ascii"                  ? Encoding::Text
                           : words[1] == "binary_little_endian" ? Encoding::LittleEndian
                                                                : Encoding::BigEndian;
            } else if (words[0] == "element") {
                read_element(words);
            } else if (words[0] == "property") {
                read_property(words);
            }
        }
        if (!ended) {
            fail("truncated: the header has no end_header");
        }
        size = lines_.offset();
    }

    Encoding encoding = Encoding::Text;
    std::vector<Element> elements;
    std::size_t size = 0; ///< bytes

    std::size_t line() const { return lines_.number(); }
    long long vertices() const {
        for (const Element& element : elements) {
            if (element.name == "vertex") {
                return element.count;
            }
        }
        return 0;
    }

private:
    template <typename... Args>
    [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
        fail_input("{}:{}: {}", name_, lines_.number(),
                   fmt::format(format, std::forward<Args>(args)...));
    }

    void read_element(const std::vector<std::string_view>& words) {
        const auto count = words.size() > 2 ? to_integer(words[2]) : std::nullopt;
        if (!count || *count < 0) {
            fail("an element needs a name and a count");
        }
        elements.push_back({std::string(words[1]), *count, {}});
    }

    void read_property(const std::vector<std::string_view>& words) {
        if (elements.empty() || words.size() < 3) {
            fail("a property needs an element, a type and a name");
        }
        Property property;
        const bool is_list = words[1] == "list";
        if (is_list && words.size() < 5) {
            fail("a list needs two types and a name");
        }
        property.value = type_of(words[is_list ? 3 : 1]);
        property.count = is_list ? type_of(words[2]) : Type{};
        if (property.value.bytes == 0 || (is_list && property.count.bytes == 0)) {
            fail("unknown type \"{}\"", words[is_list && property.count.bytes == 0 ? 2
                                              : is_list                            ? 3
                                                                                   : 1]);
        }
        const std::string_view called = words.back();
        property.is_corner_list = is_list && elements.back().name == "face" &&
                                  (called == "vertex_indices" || called == "vertex_index");
        elements.back().properties.push_back(property);
    }

    LineScanner lines_;
    const std::string& name_;
};

/// Numbers of the body one after the other, in whichever encoding; none at the end.
class Body {
public:
    Body(std::string_view bytes, Encoding encoding) : bytes_(bytes), encoding_(encoding) {}

    /// Value of an integer, 0 for a real: only counts and indices matter here.
    std::optional<long long> next(const Type& type) {
        return encoding_ == Encoding::Text ? next_word(type) : next_binary(type);
    }

private:
    std::optional<long long> next_word(const Type& type) {
        const auto is_space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
        while (at_ < bytes_.size() && is_space(bytes_[at_])) {
            ++at_;
        }
        const std::size_t start = at_;
        while (at_ < bytes_.size() && !is_space(bytes_[at_])) {
            ++at_;
        }
        const std::string_view word = bytes_.substr(start, at_ - start);
        if (type.is_real) {
            return to_number(word) ? std::optional<long long>(0) : std::nullopt;
        }
        return to_integer(word);
    }

    std::optional<long long> next_binary(const Type& type) {
        if (bytes_.size() - at_ < type.bytes) {
            return std::nullopt;
        }
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t place = encoding_ == Encoding::LittleEndian ? type.bytes - 1 - i : i;
            value = (value << 8U) | static_cast<unsigned char>(bytes_[at_ + place]);
        }
        at_ += type.bytes;
        if (type.is_real) {
            return 0;
        }
        const unsigned unused_bits = 64U - 8U * static_cast<unsigned>(type.bytes);
        return type.is_signed ? static_cast<std::int64_t>(value << unused_bits) >> unused_bits
                              : static_cast<long long>(value);
    }

    std::string_view bytes_;
    Encoding encoding_;
    std::size_t at_ = 0;
};

/// Reads one property; false when the body ends or holds no number there.
bool check_property(Body& body,
                    const Property& property,
                    long long element,
                    long long vertices,
                    const std::string& name) {
    if (property.count.bytes == 0) {
        return body.next(property.value).has_value();
    }
    const auto count = body.next(property.count);
    if (!count || *count < 0) {
        return false;
    }
    for (long long k = 0; k < *count; ++k) {
        const auto value = body.next(property.value);
        if (!value) {
            return false;
        }
        if (property.is_corner_list && (*value < 0 || *value >= vertices)) {
            fail_input("{}: face {} names vertex {}: allowed are 0 to {}", name, element, *value,
                       vertices - 1);
        }
    }
    return true;
}

} // namespace

void check_ply(std::string_view bytes, const std::string& name) {
    if (!bytes.starts_with("ply") && !bytes.starts_with("PLY")) {
        fail_input("{}: does not begin with ply", name);
    }
    const Header header(bytes, name);
    Body body(bytes.substr(header.size), header.encoding);
    for (const Element& element : header.elements) {
        // Without properties nothing follows; a wild count must not keep us busy.
        for (long long i = 0; i < element.count && !element.properties.empty(); ++i) {
            for (const Property& property : element.properties) {
                if (!check_property(body, property, i, header.vertices(), name)) {
                    fail_input("{}: damaged or truncated: {} of type {} announced, number {} is "
                               "incomplete",
                               name, element.count, element.name, i);
                }
            }
        }
    }
}

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
