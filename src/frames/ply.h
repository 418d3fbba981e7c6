#pragma once

#include "frames/frame.h"

#include <string>
#include <string_view>

namespace weft {

/// Bytes of a binary little-endian PLY: one vertex is x y z (m), for cloth also u v (rest position,
/// m) and a float for each quantity of k_quantities that the object has values of, under its name;
/// faces are triangles. Any program that reads PLY opens it.
///
/// @param comment one line for people who open the file in an editor; no line breaks
std::string encode_ply(const FrameObject& object, std::string_view comment);

/// Reads what encode_ply wrote; a file with u v is cloth, the kind of others is Obstacle.
/// Properties that are not ours are skipped, quantities that are not there stay empty. `name` and
/// `fabric` stay empty.
///
/// @param place the file's path, for messages
/// Throws Error (Disk) in one line when the header is not such a PLY, the size does not match it,
/// an index is out of range or a coordinate is not finite.
FrameObject decode_ply(std::string_view bytes, const std::string& place);

} // namespace weft
