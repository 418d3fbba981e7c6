#pragma once

#include "state/world.h"

#include <string>

namespace weft {

/// The meshes of a world's adaptive cloths as they are now, with all that hangs on their vertices
/// and does not stand in the world's own arrays of motion: masses and pins. Empty when there is no
/// adaptive cloth. Equal worlds give equal bytes.
std::string encode_meshes(const World& world);

/// Puts them back into a world made of the same scene, at its start: its cloths then have the
/// vertices that were encoded. Returns what is wrong with the bytes in words, or "".
std::string decode_meshes(std::string_view bytes, World& world);

} // namespace weft
