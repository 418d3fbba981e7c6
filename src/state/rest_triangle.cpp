#include "state/rest_triangle.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace weft {

std::array<Vec2, 3> rest_corners(const RestTriangle& rest) {
    const Mat2& m = rest.inverse_edges;
    const double det = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
    assert(det != 0.0);
    return {Vec2::Zero(), Vec2(m(1, 1), -m(1, 0)) / det, Vec2(-m(0, 1), m(0, 0)) / det};
}

double rest_edge_length(const RestTriangle& rest, int k) {
    const auto corners = rest_corners(rest);
    return (corners[static_cast<std::size_t>((k + 2) % 3)] -
            corners[static_cast<std::size_t>((k + 1) % 3)])
        .norm();
}

double least_angle(const RestTriangle& rest) {
    const auto corners = rest_corners(rest);
    double least = std::numbers::pi / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2 a = corners[(k + 1) % 3] - corners[k];
        const Vec2 b = corners[(k + 2) % 3] - corners[k];
        least = std::min(least, std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
    }
    return least;
}

} // namespace weft
