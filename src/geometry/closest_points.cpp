#include "geometry/closest_points.h"

#include <algorithm>

namespace weft {

namespace {

/// The closest of the three sides, for triangles without area.
Vec3 closest_on_sides(const Vec3& p, const std::array<Vec3, 3>& x) {
    Vec3 best = Vec3::Zero();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = (k + 1) % 3;
        const std::size_t b = (k + 2) % 3;
        const double t = closest_weight_on_segment(p, x[a], x[b]);
        const double distance = ((1.0 - t) * x[a] + t * x[b] - p).squaredNorm();
        if (distance < nearest) {
            nearest = distance;
            best.setZero();
            best[static_cast<Eigen::Index>(a)] = 1.0 - t;
            best[static_cast<Eigen::Index>(b)] = t;
        }
    }
    return best;
}

} // namespace

double closest_weight_on_segment(const Vec3& p, const Vec3& x0, const Vec3& x1) {
    const Vec3 e = x1 - x0;
    const double length_squared = e.squaredNorm();
    return length_squared > 0.0 ? std::clamp((p - x0).dot(e) / length_squared, 0.0, 1.0) : 0.0;
}

Vec3 closest_weights_on_triangle(const Vec3& p, const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    const Vec3 e1 = x1 - x0;
    const Vec3 e2 = x2 - x0;
    const Vec3 q = p - x0;
    const double a = e1.squaredNorm();
    const double b = e1.dot(e2);
    const double c = e2.squaredNorm();
    const double det = a * c - b * b;
    if (det > 1e-14 * a * c) {
        const double d1 = e1.dot(q);
        const double d2 = e2.dot(q);
        const double w1 = (c * d1 - b * d2) / det;
        const double w2 = (a * d2 - b * d1) / det;
        if (w1 >= 0.0 && w2 >= 0.0 && w1 + w2 <= 1.0) {
            return {1.0 - w1 - w2, w1, w2};
        }
    }
    return closest_on_sides(p, {x0, x1, x2}); // outside the face the closest point is on a side
}

} // namespace weft
