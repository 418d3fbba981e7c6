#pragma once

#include <string>
#include <vector>

namespace weft {

/// Round numbers along a scale.
struct Ticks {
    std::vector<double> values; ///< ascending, within [low, high]
    int decimals = 0;           ///< digits after the point that tell them apart
};

/// Multiples of 1, 2 or 5 times a power of ten in [low, high], at most `most` of them (>= 2);
/// low < high.
Ticks round_ticks(double low, double high, int most);

/// The number with so many digits after the point, without "-0"; with an exponent from a million
/// on and where six decimals would not do.
std::string format_number(double value, int decimals);

} // namespace weft
