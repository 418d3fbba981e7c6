#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace weft {

/// A colour as displayed (sRGB) or as light (linear), each channel in [0, 1]; the name says which.
using Colour = std::array<float, 3>;

float srgb_from_linear(float linear);
float linear_from_srgb(float srgb);
Colour linear_from_srgb(const Colour& srgb);

/// A named map from [0, 1] to displayed colours, and the colours of values outside its range.
struct ColourMap {
    std::string_view name;
    Colour (*colour)(float t); ///< t in [0, 1]
    bool diverging;            ///< has a neutral middle at t = 0.5
    Colour below, above;
};

/// seed: green (0,1,0) to red (1,0,0), straight in displayed RGB, as in Vogiannou et al. 2010.
/// coolwarm: Moreland 2009, "Diverging color maps for scientific visualization", blue to red
/// through light grey, computed in his Msh space. viridis, cividis, turbo: the published tables.
std::span<const ColourMap> colour_maps();

/// The map of that name; null when there is none.
const ColourMap* find_colour_map(std::string_view name);

/// What a colour stands for: a range in the quantity's unit and, for a diverging map, the value
/// that is neutral. Each side of the neutral value is stretched to its own end of the range, so a
/// colour says how much of that side of the working range is used, also where the two sides
/// differ (0.9 to 1.2). A neutral value outside the range keeps its place: the nearer end of the
/// range is then tinted.
struct ColourScale {
    const ColourMap* map = nullptr;
    double low = 0.0, high = 1.0; ///< low < high
    double neutral = 0.0;

    /// Place on the map, 0..1 within the range.
    float place(double value) const;
    /// Displayed colour of a value: the map within [low, high], else `below` or `above`.
    Colour colour(double value) const;
};

/// The colours of `count` values spread evenly over [low, high], as light (linear).
std::vector<Colour> lookup_table(const ColourScale& scale, int count);

} // namespace weft
