#pragma once

#include <string>
#include <string_view>

namespace weft {

/// Whether a name can name files everywhere: 1 to 64 letters, digits, '_' or '-', or bytes of other
/// alphabets in UTF-8; not beginning with '-'.
bool is_object_name(std::string_view name);

/// The nearest such name to any text, e.g. the stem of a file: other characters become '_'.
std::string object_name_from(std::string_view text);

} // namespace weft
