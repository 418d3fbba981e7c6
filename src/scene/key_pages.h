#pragma once

#include <span>
#include <string>
#include <vector>

/// Pages about the keys of a scene file, made from their descriptions.
namespace weft {

/// All keys in Markdown: docs/scene-keys.md.
std::string key_page();

/// The keys whose path, e.g. `cloth.fabric.bend`, contains one of the words, or all without words:
/// default, what is allowed and what the key does. "" when no key matches.
std::string key_list(std::span<const std::string> words);

/// The path of each key, in the order of the page.
std::vector<std::string> key_paths();

} // namespace weft
