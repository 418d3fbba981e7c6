#include "geometry/closest_points.h"

#include <algorithm>

namespace weft {

namespace {

/// Squared sine of the angle below which segments count as parallel; triangles as without area.
constexpr double k_parallel = 1e-15;

struct NearestSide {
    double distance_squared = std::numeric_limits<double>::infinity();
    Vec3 weights = Vec3::UnitX();
};

Vec3 closest_on_sides(const Vec3& p, const std::array<Vec3, 3>& x) {
    NearestSide best;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        const double s = closest_weight_on_segment(p, x[k], x[next]);
        const double d = (p - x[k] - s * (x[next] - x[k])).squaredNorm();
        if (d < best.distance_squared) {
            best.distance_squared = d;
            best.weights.setZero();
            best.weights[static_cast<Eigen::Index>(k)] = 1.0 - s;
            best.weights[static_cast<Eigen::Index>(next)] = s;
        }
    }
    return best.weights;
}

Vec2 closest_at_ends(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
    const std::array<Vec2, 4> pairs{Vec2(0.0, closest_weight_on_segment(a0, b0, b1)),
                                    Vec2(1.0, closest_weight_on_segment(a1, b0, b1)),
                                    Vec2(closest_weight_on_segment(b0, a0, a1), 0.0),
                                    Vec2(closest_weight_on_segment(b1, a0, a1), 1.0)};
    double least = std::numeric_limits<double>::infinity();
    Vec2 best = pairs[0];
    for (const Vec2& pair : pairs) {
        const double d = (a0 + pair[0] * (a1 - a0) - b0 - pair[1] * (b1 - b0)).squaredNorm();
        if (d < least) {
            least = d;
            best = pair;
        }
    }
    return best;
}

} // namespace

double closest_weight_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double length_squared = d.squaredNorm();
    return length_squared > 0.0 ? std::clamp(d.dot(p - a) / length_squared, 0.0, 1.0) : 0.0;
}

Vec3 closest_weights_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 ap = p - a;
    const Vec3 n = ab.cross(ac);
    const double n2 = n.squaredNorm();
    if (n2 > k_parallel * ab.squaredNorm() * ac.squaredNorm()) {
        const double wb = ap.cross(ac).dot(n) / n2;
        const double wc = ab.cross(ap).dot(n) / n2;
        const double wa = 1.0 - wb - wc;
        if (wa >= 0.0 && wb >= 0.0 && wc >= 0.0) {
            return {wa, wb, wc};
        }
    }
    return closest_on_sides(p, {a, b, c});
}

Vec2 closest_weights_on_segments(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
    const Vec3 da = a1 - a0;
    const Vec3 db = b1 - b0;
    const Vec3 r = a0 - b0;
    const double aa = da.squaredNorm();
    const double bb = db.squaredNorm();
    const double ab = da.dot(db);
    const double determinant = aa * bb - ab * ab;
    if (determinant > k_parallel * aa * bb) {
        const double ar = da.dot(r);
        const double br = db.dot(r);
        const double s = (ab * br - ar * bb) / determinant;
        const double t = (ab * s + br) / bb; // best for this s, whatever s has lost in rounding
        if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) {
            return {s, t};
        }
    }
    return closest_at_ends(a0, a1, b0, b1);
}

} // namespace weft
