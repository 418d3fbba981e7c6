#pragma once

#include "render/image.h"

#include <string>

namespace weft::test {

/// Mean absolute difference of two pictures of one size, in levels of 0..255.
double mean_difference(const Image& a, const Image& b);

/// The pixels of a PNG file. Throws std::runtime_error when it is none.
Image decode_png(const std::string& bytes);

/// The picture tests/golden/NAME.png. Throws std::runtime_error when it cannot be read.
Image read_golden(const std::string& name);

/// Mean difference to the golden picture of that name. When it is above `limit`, the picture drawn
/// and the difference (8 times, on grey) are kept beside the test program, as
/// golden/NAME.actual.png and golden/NAME.difference.png. With WEFT_UPDATE_GOLDEN set in the
/// environment the golden picture is replaced instead, and the result is 0.
double compare_with_golden(const Image& image, const std::string& name, double limit);

} // namespace weft::test
