#pragma once

#include "frames/frame.h"
#include "render/canvas.h"
#include "render/colour_map.h"

#include <array>
#include <string>
#include <vector>

namespace weft {

/// What the legend says.
struct LegendContent {
    std::string title; ///< the quantity
    std::string unit;
    ColourScale scale;
    bool has_values = false; ///< false: no cloth, so no least and greatest
    double least = 0.0, greatest = 0.0;
    std::string moment;                      ///< frame and time
    std::vector<std::string> moment_notes{}; ///< what else there is to say of it, a line each
    std::vector<std::string> objects;        ///< name and fabric of each cloth, a line each
};

LegendContent describe_frame(const Frame& frame, int quantity, const ColourScale& scale);

/// A line of text in its place.
struct LegendText {
    Rect box; ///< from the top of the line, as wide as the text
    double size = 0.0;
    bool quiet = false; ///< greyer: a unit, a fabric
    std::string text;
};

/// Where everything stands, pixels.
struct LegendLayout {
    double scale = 1.0; ///< 1 at 720 lines
    Rect panel, bar;
    Rect above, below;                        ///< patches of the colours outside the range
    std::vector<std::array<double, 2>> ticks; ///< start of each tick mark: right rim of the bar, y
    std::vector<std::array<double, 2>> markers; ///< least, greatest: left rim of the bar, y
    std::vector<LegendText> texts;
};

/// Lays the legend out in the upper right corner of a picture of this size. It grows with the
/// picture, but its text is never below 10 pixels unless the panel would then outgrow the picture.
LegendLayout lay_out_legend(const LegendContent& content, int width, int height);

void draw_legend(Image& image, const LegendContent& content);

/// Round numbers along a scale.
struct Ticks {
    std::vector<double> values; ///< ascending, within [low, high]
    int decimals = 0;           ///< digits after the point that tell them apart
};

/// Multiples of 1, 2 or 5 times a power of ten in [low, high], at most `most` of them (>= 2);
/// low < high.
Ticks round_ticks(double low, double high, int most);

/// The number with so many digits after the point, without "-0"; with an exponent from a million
/// on and where six decimals would not do.
std::string format_number(double value, int decimals);

} // namespace weft
