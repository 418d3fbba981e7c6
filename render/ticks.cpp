#include "render/ticks.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace weft {

Ticks round_ticks(double low, double high, int most) {
    assert(low < high && most >= 2);
    const double least_step = (high - low) / most;
    int exponent = static_cast<int>(std::floor(std::log10(least_step)));
    Ticks ticks;
    for (;; ++exponent) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double step = factor * std::pow(10.0, exponent);
            const double slack = 1e-9 * (high - low) / step; // the ends count in spite of rounding
            const double first = std::ceil(low / step - slack);
            const double last = std::floor(high / step + slack);
            if (last - first + 1.0 > most) {
                continue;
            }
            for (double i = first; i <= last; i += 1.0) {
                ticks.values.push_back(std::clamp(i * step, low, high));
            }
            ticks.decimals = std::max(0, -exponent);
            return ticks;
        }
    }
}

std::string format_number(double value, int decimals) {
    if (decimals > 6 || std::abs(value) >= 1e6) {
        return fmt::format("{:.3g}", value);
    }
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') {
        text.erase(0, 1);
    }
    return text;
}

} // namespace weft
