#include "scene/toml_writer.h"

#include <fmt/core.h>

namespace weft {

void TomlWriter::header(std::string_view bracketed) {
    text_ += fmt::format("{}{}\n", text_.empty() ? "" : "\n", bracketed);
}

void TomlWriter::write(std::string_view key, std::string_view value, std::string_view comment) {
    text_ += fmt::format("{} = {}", key, value);
    if (!comment.empty()) {
        text_ += fmt::format("  # {}", comment);
    }
    text_ += '\n';
}

std::string TomlWriter::toml_text(bool value) {
    return value ? "true" : "false";
}

std::string TomlWriter::toml_text(int value) {
    return fmt::format("{}", value);
}

std::string TomlWriter::toml_text(double value) {
    const std::string text = fmt::format("{}", value);
    const bool reads_as_integer = text.find_first_not_of("-0123456789") == std::string::npos;
    return reads_as_integer ? text + ".0" : text;
}

std::string TomlWriter::toml_text(const std::string& value) {
    std::string text = "\"";
    for (const char c : value) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            text += '\\';
            text += c;
        } else if (byte < 0x20 || byte == 0x7f) {
            text += fmt::format("\\u{:04x}", byte);
        } else {
            text += c;
        }
    }
    return text + '"';
}

} // namespace weft
