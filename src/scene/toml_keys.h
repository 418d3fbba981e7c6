#pragma once

#include "scene/key.h"
#include "scene/scene_writer.h"
#include "scene/toml_table.h"

#include <functional>
#include <optional>
#include <string>

/// Described keys in TOML: how their values are read and written.
namespace weft {

/// Reads the keys that the table has into the values to which they are bound; the others keep their
/// values. Throws Error (BadInput) for a value of the wrong type; ranges are left to problem_of.
void read_keys(TomlTable& table, const Keys& keys);

/// How a path of the scene is written.
using PathText = std::function<std::string(const std::string&)>;

/// The value of a key as TOML; nothing when a written scene leaves it out.
std::optional<std::string> value_text(const Key& key, const PathText& path_text);

/// A line for each key that a written scene has, with its note or unit behind it.
void write_keys(TomlWriter& out, const Keys& keys, const PathText& path_text);

} // namespace weft
