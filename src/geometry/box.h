#pragma once

#include "base/eigen.h"

#include <algorithm>
#include <limits>

namespace weft {

/// Axis-aligned box in single precision; the conversion from double rounds outwards, so a box never
/// misses what it was made of. Starts empty.
struct Box {
    std::array<float, 3> low = {k_empty, k_empty, k_empty};
    std::array<float, 3> high = {-k_empty, -k_empty, -k_empty};

    static constexpr float k_empty = std::numeric_limits<float>::infinity();
};

/// The largest float not above x, or the one below it; of lowest magnitudes 1e-38.
inline float float_below(double x) {
    const auto f = static_cast<float>(x);
    return f - (std::abs(f) * 1.2e-7F + 1e-37F);
}

/// The smallest float not below x, or the one above it.
inline float float_above(double x) {
    const auto f = static_cast<float>(x);
    return f + (std::abs(f) * 1.2e-7F + 1e-37F);
}

/// Box of the segment from a to b, larger by `margin` (m) on all sides.
inline Box segment_box(const Vec3& a, const Vec3& b, double margin) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        box.low[k] = float_below(std::min(a[i], b[i]) - margin);
        box.high[k] = float_above(std::max(a[i], b[i]) + margin);
    }
    return box;
}

inline Box unite(const Box& a, const Box& b) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = std::min(a.low[k], b.low[k]);
        box.high[k] = std::max(a.high[k], b.high[k]);
    }
    return box;
}

/// True when the closed boxes share a point. Bitwise on purpose: one branch instead of six.
inline bool overlap(const Box& a, const Box& b) {
    return static_cast<bool>(int(a.low[0] <= b.high[0]) & int(b.low[0] <= a.high[0]) &
                             int(a.low[1] <= b.high[1]) & int(b.low[1] <= a.high[1]) &
                             int(a.low[2] <= b.high[2]) & int(b.low[2] <= a.high[2]));
}

/// Square of the distance (m^2) from a point to a box; 0 inside.
inline double distance_squared(const Box& box, const Vec3& p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = p[static_cast<Eigen::Index>(k)];
        const double outside = std::max(
            {0.0, static_cast<double>(box.low[k]) - x, x - static_cast<double>(box.high[k])});
        sum += outside * outside;
    }
    return sum;
}

} // namespace weft
