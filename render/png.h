#pragma once

#include "render/image.h"

#include <string>

namespace weft {

/// The picture as the bytes of a PNG file (stb_image_write, compressed by libdeflate). Equal
/// pictures give equal bytes. Throws Error (Disk) when memory runs out.
std::string encode_png(const Image& image);

} // namespace weft
