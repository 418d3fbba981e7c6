#pragma once

#include "render/colour_map.h"
#include "render/image.h"

#include <array>

namespace weft {

/// A rectangle in pixels from the top left corner; pixel i spans [i, i + 1].
struct Rect {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

    double right() const { return x + width; }
    double bottom() const { return y + height; }
    bool contains(const Rect& inner) const {
        return inner.x >= x && inner.y >= y && inner.right() <= right() &&
               inner.bottom() <= bottom();
    }
};

/// Mixes `opacity` (0..1) of a displayed colour into a pixel; outside of the picture nothing
/// happens.
void blend(Image& image, int x, int y, const Colour& srgb, double opacity);

/// Fills a rectangle with corners of this radius, smooth at its rim.
void fill_rounded(
    Image& image, const Rect& rect, double radius, const Colour& srgb, double opacity);

/// A ring whose line of this width lies about this radius, smooth at its rims.
void draw_ring(Image& image,
               const std::array<double, 2>& centre,
               double radius,
               double width,
               const Colour& srgb);

/// Fills a triangle, smooth at its rim.
void fill_triangle(Image& image,
                   const std::array<std::array<double, 2>, 3>& corners,
                   const Colour& srgb,
                   double opacity);

} // namespace weft
