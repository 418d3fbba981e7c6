#include "render/canvas.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

constexpr int k_grid = 4; // points a side at which a pixel is tested for being inside

/// Blends each pixel of the box by the fraction of its points for which inside(x, y).
template <typename Inside>
void fill(Image& image, const Rect& box, const Colour& srgb, double opacity, const Inside& inside) {
    const int x_end = std::min(image.width, static_cast<int>(std::ceil(box.right())));
    const int y_end = std::min(image.height, static_cast<int>(std::ceil(box.bottom())));
    for (int y = std::max(0, static_cast<int>(std::floor(box.y))); y < y_end; ++y) {
        for (int x = std::max(0, static_cast<int>(std::floor(box.x))); x < x_end; ++x) {
            int count = 0;
            for (int i = 0; i < k_grid * k_grid; ++i) {
                count += inside(x + (i % k_grid + 0.5) / k_grid, y + (i / k_grid + 0.5) / k_grid)
                             ? 1
                             : 0;
            }
            blend(image, x, y, srgb, opacity * count / (k_grid * k_grid));
        }
    }
}

} // namespace

void blend(Image& image, int x, int y, const Colour& srgb, double opacity) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height || opacity <= 0.0) {
        return;
    }
    std::uint8_t* pixel = image.pixel(x, y);
    for (std::size_t i = 0; i < 3; ++i) {
        const double mixed =
            pixel[i] + std::min(opacity, 1.0) * (255.0 * static_cast<double>(srgb[i]) - pixel[i]);
        pixel[i] = static_cast<std::uint8_t>(std::lround(std::clamp(mixed, 0.0, 255.0)));
    }
}

void fill_rounded(
    Image& image, const Rect& rect, double radius, const Colour& srgb, double opacity) {
    fill(image, rect, srgb, opacity, [&](double x, double y) {
        const double dx = std::max({rect.x + radius - x, x - rect.right() + radius, 0.0});
        const double dy = std::max({rect.y + radius - y, y - rect.bottom() + radius, 0.0});
        const bool within = x >= rect.x && x <= rect.right() && y >= rect.y && y <= rect.bottom();
        return within && (radius <= 0.0 || dx * dx + dy * dy <= radius * radius);
    });
}

void draw_ring(Image& image,
               const std::array<double, 2>& centre,
               double radius,
               double width,
               const Colour& srgb) {
    const double outer = radius + 0.5 * width;
    const Rect box{centre[0] - outer, centre[1] - outer, 2.0 * outer, 2.0 * outer};
    if (box.right() < 0.0 || box.bottom() < 0.0 || box.x > image.width || box.y > image.height) {
        return; // far away, its pixels have no numbers
    }
    fill(image, box, srgb, 1.0, [&](double x, double y) {
        const double r = std::hypot(x - centre[0], y - centre[1]);
        return std::abs(r - radius) <= 0.5 * width;
    });
}

void fill_triangle(Image& image,
                   const std::array<std::array<double, 2>, 3>& corners,
                   const Colour& srgb,
                   double opacity) {
    const auto [left, right] = std::minmax({corners[0][0], corners[1][0], corners[2][0]});
    const auto [top, bottom] = std::minmax({corners[0][1], corners[1][1], corners[2][1]});
    const auto side = [&](std::size_t a, std::size_t b, double x, double y) {
        return (corners[b][0] - corners[a][0]) * (y - corners[a][1]) -
               (corners[b][1] - corners[a][1]) * (x - corners[a][0]);
    };
    fill(image, {left, top, right - left, bottom - top}, srgb, opacity, [&](double x, double y) {
        const double a = side(0, 1, x, y);
        const double b = side(1, 2, x, y);
        const double c = side(2, 0, x, y);
        return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
    });
}

} // namespace weft
