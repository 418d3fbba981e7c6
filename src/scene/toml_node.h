#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

/// One value of a TOML tree: where it stands, how it reads, what it is. `path` names it in
/// messages, e.g. `cloth[0].fabric.density`. Refusals throw Error (BadInput).
namespace weft {

/// Where a node stands: `shirt.toml:12:9`, or `--set KEY=VALUE` when it came from there.
std::string place_of(const toml::source_region& source);

/// A value as the user would write it, on one line, shortened when long.
std::string text_of(const toml::node& node);

/// Throws `place: path = value: what`.
[[noreturn]] void fail_at(const toml::node& node, const std::string& path, std::string_view what);

/// A finite number; an integer counts as one.
double number_at(const toml::node& node, const std::string& path);

/// An integer that fits an int.
int integer_at(const toml::node& node, const std::string& path);

/// An array, of `size` elements when that is not 0; `of_what` names them in the message.
const toml::array&
array_at(const toml::node& node, const std::string& path, std::size_t size, const char* of_what);

} // namespace weft
