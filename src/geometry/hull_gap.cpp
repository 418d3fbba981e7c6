#include "geometry/hull_gap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

namespace {

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Weights of a point in the plane on a triangle's corners when it lies in the triangle.
std::optional<Vec3> weights_inside(const Vec2& p, const std::array<Vec2, 3>& t) {
    const double area = cross(t[1] - t[0], t[2] - t[0]);
    if (area == 0.0) {
        return std::nullopt; // seen from its side
    }
    const double w1 = cross(p - t[0], t[2] - t[0]) / area;
    const double w2 = cross(t[1] - t[0], p - t[0]) / area;
    const Vec3 w(1.0 - w1 - w2, w1, w2);
    return w.minCoeff() >= 0.0 ? std::optional<Vec3>(w) : std::nullopt;
}

/// Parameters on segments a and b where they cross.
std::optional<Vec2> segments_cross(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1) {
    const double span = cross(a1 - a0, b1 - b0);
    if (span == 0.0) {
        return std::nullopt;
    }
    const Vec2 s(cross(b0 - a0, b1 - b0) / span, cross(b0 - a0, a1 - a0) / span);
    const bool inside = s.minCoeff() >= 0.0 && s.maxCoeff() <= 1.0;
    return inside ? std::optional<Vec2>(s) : std::nullopt;
}

Vec3 place(const std::array<Vec3, 3>& x, const Vec3& w) {
    return w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
}

} // namespace

void column_gaps(const std::array<Vec3, 3>& upper,
                 const std::array<Vec3, 3>& lower,
                 const Vec3& n,
                 std::vector<ColumnGap>& gaps) {
    const Vec3 e1 = n.unitOrthogonal();
    const Vec3 e2 = n.cross(e1);
    const auto seen = [&](const Vec3& x) { return Vec2(e1.dot(x), e2.dot(x)); };
    const std::array<Vec2, 3> u{seen(upper[0]), seen(upper[1]), seen(upper[2])};
    const std::array<Vec2, 3> l{seen(lower[0]), seen(lower[1]), seen(lower[2])};
    const auto add = [&](const Vec3& on_upper, const Vec3& base) {
        gaps.push_back({on_upper, base, n.dot(place(upper, on_upper) - base)});
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (const auto w = weights_inside(u[k], l)) {
            add(Vec3::Unit(static_cast<Eigen::Index>(k)), place(lower, *w));
        }
        if (const auto w = weights_inside(l[k], u)) {
            add(*w, lower[k]);
        }
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t k1 = (k + 1) % 3;
            const std::size_t j1 = (j + 1) % 3;
            if (const auto s = segments_cross(u[k], u[k1], l[j], l[j1])) {
                Vec3 w = Vec3::Zero();
                w[static_cast<Eigen::Index>(k)] = 1.0 - (*s)[0];
                w[static_cast<Eigen::Index>(k1)] = (*s)[0];
                add(w, lower[j] + (*s)[1] * (lower[j1] - lower[j]));
            }
        }
    }
}

} // namespace weft
