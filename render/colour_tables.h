#pragma once

#include <array>
#include <cstdint>

namespace weft {

/// Published colour maps as 0xRRGGBB (sRGB): every fifth of their 256 entries, from 0 to 255.
/// Straight lines between these keep within 0.004 of the whole table (cividis 0.016, at a kink).
using ColourTable = std::array<std::uint32_t, 52>;

extern const ColourTable k_viridis;
extern const ColourTable k_cividis;
extern const ColourTable k_turbo;

} // namespace weft
