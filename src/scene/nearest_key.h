#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours; case counts
/// half) to `word`; the earlier one of equals; "" for no candidates.
std::string nearest_key(std::string_view word, std::span<const std::string> candidates);

} // namespace weft
