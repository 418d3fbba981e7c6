#include "scene/parse_toml.h"

#include "base/error.h"

#include <algorithm>

namespace weft {

toml::table parse_toml(std::string_view text, const std::string& place) {
    try {
        return toml::parse(text, place);
    } catch (const toml::parse_error& error) {
        std::string what(error.description());
        std::replace(what.begin(), what.end(), '\n', ' ');
        const toml::source_position at = error.source().begin;
        fail_input("{}:{}:{}: not TOML: {}", place, at.line, at.column, what);
    }
}

} // namespace weft
