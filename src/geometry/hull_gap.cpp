#include "geometry/hull_gap.h"

#include <algorithm>
#include <limits>
#include <span>

namespace weft {

namespace {

/// Gap between two point sets along a direction of any length; no gap along one that vanishes
/// beside `scale`, the square of a length.
double
gap_along_axis(std::span<const Vec3> a, std::span<const Vec3> b, const Vec3& axis, double scale) {
    const double length = axis.norm();
    if (length <= 1e-12 * scale) {
        return -std::numeric_limits<double>::infinity();
    }
    const auto range = [&](std::span<const Vec3> points) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Vec3& p : points) {
            const double s = axis.dot(p);
            low = std::min(low, s);
            high = std::max(high, s);
        }
        return std::pair(low, high);
    };
    const auto [low_a, high_a] = range(a);
    const auto [low_b, high_b] = range(b);
    return std::max(low_b - high_a, low_a - high_b) / length;
}

} // namespace

double hull_gap(const std::array<Vec3, 4>& tetrahedron, const std::array<Vec3, 3>& triangle) {
    const auto& t = tetrahedron;
    const std::array<Vec3, 6> edges{t[1] - t[0], t[2] - t[0], t[3] - t[0],
                                    t[2] - t[1], t[3] - t[1], t[3] - t[2]};
    const std::array<Vec3, 3> sides{triangle[1] - triangle[0], triangle[2] - triangle[1],
                                    triangle[0] - triangle[2]};
    double scale = 0.0;
    for (const Vec3& edge : edges) {
        scale = std::max(scale, edge.squaredNorm());
    }
    for (const Vec3& side : sides) {
        scale = std::max(scale, side.squaredNorm());
    }
    double widest = -std::numeric_limits<double>::infinity();
    const auto try_axis = [&](const Vec3& axis) {
        widest = std::max(widest, gap_along_axis(tetrahedron, triangle, axis, scale));
    };
    const Vec3 normal = sides[0].cross(sides[1]);
    try_axis(normal);
    try_axis(edges[0].cross(edges[1])); // faces of the tetrahedron
    try_axis(edges[0].cross(edges[2]));
    try_axis(edges[1].cross(edges[2]));
    try_axis(edges[3].cross(edges[4]));
    for (const Vec3& side : sides) {
        try_axis(side.cross(normal)); // both may lie in one plane
        for (const Vec3& edge : edges) {
            try_axis(side.cross(edge));
        }
    }
    for (const Vec3& edge : edges) {
        for (const Vec3& other : {edges[0].cross(edges[1]), edges[2].cross(edges[3])}) {
            try_axis(edge.cross(other) / std::sqrt(scale));
        }
    }
    return widest;
}

} // namespace weft
