#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace weft {

/// Parses TOML text; `place` names it in messages. Throws Error (BadInput): `place:line:column:
/// what the parser says`.
toml::table parse_toml(std::string_view text, const std::string& place);

/// Applies one `KEY=VALUE` of the command line to a scene's tree, before it is read. KEY is a path:
/// `scene.frames`, `cloth[0].fabric.bend`, `cloth.0.name`, or with the object's name,
/// `cloth.shirt.fabric.density`. VALUE is TOML; what is not is taken as a string. A fabric given by
/// name becomes a table with that base when a key below it is set.
/// Throws Error (BadInput) naming the option when the path leads nowhere.
void apply_set(toml::table& root, const std::string& set);

} // namespace weft
