#include "geometry/continuous.h"

#include <algorithm>
#include <limits>

namespace weft {

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
