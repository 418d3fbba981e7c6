#include "scene/toml_node.h"

#include "base/error.h"
#include "scene/scene_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace weft {
namespace {

/// Numbers in their shortest form, which toml++ does not give.
std::string whole_text_of(const toml::node& node) {
    if (const toml::array* array = node.as_array()) {
        std::string list;
        for (const toml::node& element : *array) {
            list += (list.empty() ? "" : ", ") + whole_text_of(element);
        }
        return '[' + list + ']';
    }
    if (node.is_table()) {
        return "{...}";
    }
    if (const toml::value<double>* number = node.as_floating_point()) {
        return fmt::format("{}", number->get());
    }
    std::ostringstream stream;
    node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) {
            stream << toml::toml_formatter{value, toml::format_flags::none};
        }
    });
    return stream.str();
}

} // namespace

std::string place_of(const toml::source_region& source) {
    const std::string file = source.path ? *source.path : "scene";
    if (file.starts_with("--set ") || file == k_command_line_place) {
        return file;
    }
    return fmt::format("{}:{}:{}", file, source.begin.line, source.begin.column);
}

std::string text_of(const toml::node& node) {
    std::string text = whole_text_of(node);
    std::replace(text.begin(), text.end(), '\n', ' ');
    constexpr std::size_t k_longest = 60;
    if (text.size() > k_longest) {
        text.resize(k_longest);
        text += "...";
    }
    return text;
}

void fail_at(const toml::node& node, const std::string& path, std::string_view what) {
    fail_input("{}: {} = {}: {}", place_of(node.source()), path, text_of(node), what);
}

double number_at(const toml::node& node, const std::string& path) {
    if (!node.is_number()) {
        fail_at(node, path, "must be a number");
    }
    const double value = node.value<double>().value_or(std::nan(""));
    if (!std::isfinite(value)) {
        fail_at(node, path, "must be finite");
    }
    return value;
}

int integer_at(const toml::node& node, const std::string& path) {
    const auto value = node.value_exact<std::int64_t>();
    if (!value) {
        fail_at(node, path, "must be an integer");
    }
    constexpr std::int64_t k_most = std::numeric_limits<int>::max();
    if (*value > k_most || *value < -k_most) {
        fail_at(node, path, "must be an integer of at most 2147483647");
    }
    return static_cast<int>(*value);
}

const toml::array&
array_at(const toml::node& node, const std::string& path, std::size_t size, const char* of_what) {
    const toml::array* array = node.as_array();
    if (array == nullptr || (size > 0 && array->size() != size)) {
        const std::string count = size > 0 ? fmt::format("{} ", size) : "";
        fail_at(node, path, fmt::format("must be an array of {}{}", count, of_what));
    }
    return *array;
}

} // namespace weft
