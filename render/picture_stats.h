#pragma once

#include "render/colour_map.h"
#include "render/image.h"
#include "render/painter.h"

#include <array>

namespace weft {

/// What a picture shows, counted one sample a pixel (at its centre) from the values themselves,
/// not from colours; the legend hides nothing here.
struct PictureStats {
    double covered_share = 0.0; ///< of all pixels, those that show cloth
    double above_share = 0.0;   ///< of the covered pixels, those above the range
    double below_share = 0.0;
    std::array<double, 3> mean_colour{}; ///< of the finished picture's bytes, legend included; 0..1
};

/// Counts the values; mean_colour stays zero.
PictureStats count_values(const ValuePicture& values, const ColourScale& scale);

/// Mean of a picture's bytes, 0..1.
std::array<double, 3> mean_colour(const Image& image);

} // namespace weft
