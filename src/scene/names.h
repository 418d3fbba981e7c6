#pragma once

#include "scene/quantities.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace weft {

/// Names of the colour maps (render/colour_map.h); a test holds both sides together.
inline constexpr std::array<std::string_view, 5> k_map_names{"seed", "coolwarm", "viridis", "turbo",
                                                             "cividis"};

template <std::size_t N>
constexpr bool is_one_of(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether a name can name files everywhere: 1 to 64 letters, digits, '_' or '-', or bytes of other
/// alphabets in UTF-8; not beginning with '-'.
bool is_object_name(std::string_view name);

/// The nearest such name to any text, e.g. the stem of a file: other characters become '_'.
std::string object_name_from(std::string_view text);

} // namespace weft
