#include "geometry/distance.h"

#include <algorithm>
#include <limits>

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

Separation separation(PairKind kind, const PairPoints& x) {
    Separation result;
    if (kind == PairKind::VertexFace) {
        const Vec3 w = closest_weights_on_triangle(x[0], x[1], x[2], x[3]);
        result.weights = {1.0, -w[0], -w[1], -w[2]};
        // Differences first: far from the origin the weighted sum would lose digits.
        result.normal = x[0] - x[1] - w[1] * (x[2] - x[1]) - w[2] * (x[3] - x[1]);
    } else {
        const Vec2 p = closest_weights_on_segments(x[0], x[1], x[2], x[3]);
        result.weights = {1.0 - p[0], p[0], -(1.0 - p[1]), -p[1]};
        result.normal = x[0] - x[2] + p[0] * (x[1] - x[0]) - p[1] * (x[3] - x[2]);
    }
    result.distance = result.normal.norm();
    if (result.distance > 0.0) {
        result.normal /= result.distance;
    }
    return result;
}

double gap_along(PairKind kind, const PairPoints& x, const Vec3& n) {
    const std::size_t split = first_side(kind);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < split; ++i) {
        for (std::size_t j = split; j < 4; ++j) {
            least = std::min(least, n.dot(x[i] - x[j]));
        }
    }
    return least;
}

// Two lower bounds of the time during which a pair at distance d stays apart:
//
// 1. The distance shrinks no faster than the largest |displacement_i - displacement_j| over i in
//    side 1, j in side 2 (closest points are convex combinations of the vertices).
// 2. With n from the closest points, n . (x_i - x_j) >= d > 0 for all i, j; each is linear in t,
//    so the first of them to fall to the wanted gap is known exactly. Sliding and parting pairs
//    are done with in one step.
//
// The larger bound is taken; each ends at a fraction of the gap, so the time found is never late.

namespace {

/// Fraction of the remaining gap that may be used up in one step; nearer to 1: fewer steps, less
/// room for rounding.
constexpr double k_step_fraction = 0.9;

/// Below this fraction of the gap at the start the pair counts as met; smaller: later times, more
/// steps.
constexpr double k_met_fraction = 0.1;

/// After so many steps the time reached is reported as the impact.
constexpr int k_max_steps = 1000;

double largest_approach(PairKind kind, const PairPoints& displacement) {
    const std::size_t split = first_side(kind);
    double largest = 0.0;
    for (std::size_t i = 0; i < split; ++i) {
        for (std::size_t j = split; j < 4; ++j) {
            largest = std::max(largest, (displacement[i] - displacement[j]).squaredNorm());
        }
    }
    return std::sqrt(largest);
}

/// Time after which some n . (x_i - x_j) has fallen to `floor`.
double time_apart(PairKind kind,
                  const PairPoints& x,
                  const PairPoints& displacement,
                  const Vec3& n,
                  double floor) {
    const std::size_t split = first_side(kind);
    double time = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < split; ++i) {
        for (std::size_t j = split; j < 4; ++j) {
            const double gap = n.dot(x[i] - x[j]);
            const double rate = n.dot(displacement[i] - displacement[j]);
            if (rate < 0.0) {
                time = std::min(time, std::max(gap - floor, 0.0) / -rate);
            }
        }
    }
    return time;
}

} // namespace

std::optional<double> time_of_impact(PairKind kind,
                                     const PairPoints& start,
                                     const PairPoints& displacement,
                                     const ApproachLimit& limit) {
    const double approach = largest_approach(kind, displacement);
    Separation now = separation(kind, start);
    const double min_separation = std::min(limit.distance, limit.fraction * now.distance);
    const double start_gap = now.distance - min_separation;
    if (start_gap <= 0.0) {
        return 0.0;
    }
    double t = 0.0;
    PairPoints x = start;
    for (int step = 0; step < k_max_steps; ++step) {
        const double gap = now.distance - min_separation;
        if (step > 0 && gap < k_met_fraction * start_gap) {
            return t;
        }
        const double kept = (1.0 - k_step_fraction) * gap;
        const double by_distance =
            approach > 0.0 ? (gap - kept) / approach : std::numeric_limits<double>::infinity();
        const double by_direction =
            time_apart(kind, x, displacement, now.normal, min_separation + kept);
        const double advance = std::max(by_distance, by_direction);
        if (t + advance >= 1.0) {
            return std::nullopt;
        }
        t += advance;
        for (std::size_t i = 0; i < 4; ++i) {
            x[i] = start[i] + t * displacement[i];
        }
        now = separation(kind, x);
    }
    return t;
}

} // namespace weft
