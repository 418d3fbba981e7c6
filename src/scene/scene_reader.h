#pragma once

#include "scene/params.h"

#include <span>
#include <string>
#include <string_view>

namespace weft {

/// Reads a scene file, with `KEY=VALUE` overrides applied before it is read (see apply_set).
///
/// Everything that can be said without opening a mesh is checked: types, ranges, names, unknown and
/// missing keys. Throws Error: Disk when the file cannot be read, otherwise BadInput in one line
/// `file:line:column: key = value: what is allowed` (or `--set KEY=VALUE: ...`).
Scene read_scene(const std::filesystem::path& file, std::span<const std::string> sets = {});

/// A place that is no file: messages then name it without line and column.
inline constexpr const char* k_command_line_place = "command line";

/// The same from text; `place` stands for the file in messages.
Scene read_scene_text(std::string_view text,
                      const std::string& place,
                      const std::filesystem::path& base_dir,
                      std::span<const std::string> sets = {});

} // namespace weft
