#pragma once

#include <algorithm>
#include <cmath>

/// Step lengths along a direction of descent: alpha = 1 is the whole step.
namespace weft {

/// A full Newton step is accepted when the slope of the potential along it has fallen to this
/// fraction of its start. Larger: overshoots are let through; smaller: steps are cut that would
/// have been good.
inline constexpr double k_slope_fraction = 0.5;

/// Halves alpha, beginning with the given one, until accept(alpha) or `most` were tried. Returns
/// the alpha that was accepted, or the half of the last one tried.
template <typename Accept> double backtrack(double alpha, int most, const Accept& accept) {
    for (int i = 0; i < most; ++i, alpha *= 0.5) {
        if (accept(alpha)) {
            return alpha;
        }
    }
    return alpha;
}

/// The alpha > 0 at which the slope of a convex function along a line has all but vanished: to
/// `fraction` of its (negative) slope at 0. The bracket is doubled up to alpha = 16, then cut at
/// most 40 times.
///
/// @param slope_at  slope by alpha, never falling
template <typename Slope> double find_minimum(const Slope& slope_at, double fraction) {
    constexpr double k_longest_step = 16.0;
    constexpr int k_most_cuts = 40;
    const double enough = fraction * std::abs(slope_at(0.0));
    double low = 0.0;
    double slope_low = slope_at(low);
    double high = 1.0;
    double slope_high = slope_at(high);
    while (slope_high < -enough && high < k_longest_step) {
        low = high;
        slope_low = slope_high;
        high *= 2.0;
        slope_high = slope_at(high);
    }
    if (slope_high <= enough) {
        return high;
    }
    double alpha = high;
    for (int i = 0; i < k_most_cuts; ++i) {
        // The root of the secant, but well inside the bracket: slopes may have kinks.
        const double secant = low - slope_low * (high - low) / (slope_high - slope_low);
        alpha = std::clamp(secant, low + 0.1 * (high - low), high - 0.1 * (high - low));
        const double here = slope_at(alpha);
        if (std::abs(here) <= enough) {
            break;
        }
        (here < 0.0 ? low : high) = alpha;
        (here < 0.0 ? slope_low : slope_high) = here;
    }
    return alpha;
}

} // namespace weft
