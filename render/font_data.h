#pragma once

#include <span>

namespace weft {

/// DejaVu Sans as a TrueType file, taken into the program when it is built (Bitstream Vera licence
/// with public domain additions), so that the program needs no font where it runs.
std::span<const unsigned char> font_data();

} // namespace weft
