#pragma once

namespace weft {

/// True in builds of type Debug. Our cheap asserts stay in release builds; checks that cost time
/// ask for this.
#ifdef WEFT_DEBUG_BUILD
inline constexpr bool k_is_debug_build = true;
#else
inline constexpr bool k_is_debug_build = false;
#endif

} // namespace weft
