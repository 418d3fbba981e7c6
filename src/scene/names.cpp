#include "scene/names.h"

#include <algorithm>
#include <cctype>

namespace weft {
namespace {

constexpr std::size_t k_longest_name = 64;

bool is_allowed(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isalnum(byte) != 0 || c == '_' || c == '-';
}

} // namespace

bool is_object_name(std::string_view name) {
    return !name.empty() && name.size() <= k_longest_name && name.front() != '-' &&
           std::all_of(name.begin(), name.end(), is_allowed);
}

std::string object_name_from(std::string_view text) {
    std::string name(text.substr(0, k_longest_name));
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !is_allowed(c); }, '_');
    if (name.empty() || name.front() == '-') {
        name.insert(name.begin(), '_');
    }
    return name.substr(0, k_longest_name);
}

} // namespace weft
