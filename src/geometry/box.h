#pragma once

#include "base/eigen.h"

#include <algorithm>
#include <limits>
#if defined(__SSE2__)
#include <emmintrin.h>

#include <cstring>
#endif

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

/// True when the closed boxes share a point. One branch instead of six: which of them it would be
/// could not be foreseen.
inline bool overlap(const Box& a, const Box& b) {
#if defined(__SSE2__)
    static_assert(sizeof(Box) == 6 * sizeof(float));
    const auto load = [](const Box& box, std::size_t first) {
        __m128 four;
        std::memcpy(&four, reinterpret_cast<const char*>(&box) + first * sizeof(float),
                    sizeof four);
        return four;
    };
    const auto low = [&](const Box& box) { return load(box, 0); }; // and one more
    const auto high = [&](const Box& box) {
        const __m128 last = load(box, 2); // one before them
        return _mm_shuffle_ps(last, last, _MM_SHUFFLE(3, 3, 2, 1));
    };
    const __m128 meets = _mm_and_ps(_mm_cmple_ps(low(a), high(b)), _mm_cmple_ps(low(b), high(a)));
    return (_mm_movemask_ps(meets) & 7) == 7;
#else
    return static_cast<bool>(int(a.low[0] <= b.high[0]) & int(b.low[0] <= a.high[0]) &
                             int(a.low[1] <= b.high[1]) & int(b.low[1] <= a.high[1]) &
                             int(a.low[2] <= b.high[2]) & int(b.low[2] <= a.high[2]));
#endif
}

/// Four boxes side by side; those not set are empty.
struct FourBoxes {
    std::array<std::array<float, 4>, 3> low, high; ///< by axis

    FourBoxes() {
        low.fill({Box::k_empty, Box::k_empty, Box::k_empty, Box::k_empty});
        high.fill({-Box::k_empty, -Box::k_empty, -Box::k_empty, -Box::k_empty});
    }
    void set(std::size_t i, const Box& box) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k][i] = box.low[k];
            high[k][i] = box.high[k];
        }
    }
};

/// Bit i is set when box i of four overlaps this one.
inline unsigned overlaps_of(const FourBoxes& four, const Box& box) {
#if defined(__SSE2__)
    __m128 meets = _mm_castsi128_ps(_mm_set1_epi32(-1));
    for (std::size_t k = 0; k < 3; ++k) {
        const __m128 low = _mm_loadu_ps(four.low[k].data());
        const __m128 high = _mm_loadu_ps(four.high[k].data());
        meets = _mm_and_ps(meets, _mm_and_ps(_mm_cmple_ps(low, _mm_set1_ps(box.high[k])),
                                             _mm_cmple_ps(_mm_set1_ps(box.low[k]), high)));
    }
    return static_cast<unsigned>(_mm_movemask_ps(meets));
#else
    unsigned meets = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        bool all = true;
        for (std::size_t k = 0; k < 3; ++k) {
            all = all && four.low[k][i] <= box.high[k] && box.low[k] <= four.high[k][i];
        }
        meets |= (all ? 1U : 0U) << i;
    }
    return meets;
#endif
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
