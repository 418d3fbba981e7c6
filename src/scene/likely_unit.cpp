#include "scene/likely_unit.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

namespace weft {

namespace {

struct Unit {
    const char* name;
    double metres;
};

constexpr std::array<Unit, 4> k_units{{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}}};

} // namespace

std::string size_warning(double size, double metres_per_unit) {
    if (!(size > 0.0) || (size >= 0.01 && size <= 10.0)) {
        return "";
    }
    std::string likely;
    for (const Unit& unit : k_units) {
        const double would_be = size / metres_per_unit * unit.metres;
        const bool is_other = std::abs(unit.metres / metres_per_unit - 1.0) > 1e-6;
        if (is_other && would_be >= 0.1 && would_be <= 3.0) {
            likely += fmt::format("{}\"{}\" ({:.3g} m)", likely.empty() ? "" : " or ", unit.name,
                                  would_be);
        }
    }
    const std::string hint = likely.empty() ? "set units or scale" : "units may be " + likely;
    return fmt::format("the largest dimension is {:.4g} m, outside 1 cm to 10 m: {}", size, hint);
}

} // namespace weft
