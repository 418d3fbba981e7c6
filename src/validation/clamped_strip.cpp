#include "validation/clamped_strip.h"

#include <algorithm>
#include <cmath>

#include "validation/sheet_world.h"

namespace weft {

ClampedStrip::ClampedStrip(
    Pattern pattern, int cells, int cells_across, double length, double width)
    : sheet(make_sheet(pattern, cells + 1, cells_across, cells + 1, cells_across)),
      cell(length / (cells + 0.5)) {
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        Vec2& p = sheet.points[i];
        if (i % static_cast<std::size_t>(cells + 2) == 1) {
            p = Vec2(1.0, std::round(p.y())); // the clamp's line is straight
        }
        p = Vec2((p.x() - 1.0) * cell, p.y() * width / cells_across);
    }
}

std::vector<Index> ClampedStrip::clamp() const {
    return vertices_where(sheet, [](const Vec2& p) { return p.x() < 1e-9; });
}

std::vector<Index> ClampedStrip::free_end() const {
    double end = 0.0;
    for (const Vec2& p : sheet.points) {
        end = std::max(end, p.x());
    }
    return vertices_where(sheet, [=](const Vec2& p) { return p.x() > end - 1e-9; });
}

int square_cells_across(int cells, double length, double width) {
    return std::max(1, static_cast<int>(std::lround(width / length * (cells + 0.5))));
}

} // namespace weft
