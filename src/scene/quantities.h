#pragma once

#include <array>
#include <string_view>

namespace weft {

/// A quantity that pictures can show as colour: all that the program knows of it but how it is
/// measured (frames/capture.cpp). The scene's choices, the command line's help, the legend and the
/// cache are made of this table: a new quantity is one entry and its measure.
struct Quantity {
    std::string_view name;  ///< in the scene file and in the cache
    std::string_view title; ///< in the legend
    std::string_view unit;
    double low, high; ///< range when the scene gives none; stretch has the fabric's working range
    double neutral;   ///< value at the middle of a diverging colour map
};

inline constexpr std::array k_quantities{
    Quantity{"stretch", "principal stretch", "1", 0.9, 1.2, 1.0},
    Quantity{"strain_weft", "strain along weft", "%", -10.0, 10.0, 0.0},
    Quantity{"strain_warp", "strain along warp", "%", -10.0, 10.0, 0.0},
    Quantity{"shear", "shear angle", "deg", -20.0, 20.0, 0.0},
    Quantity{"stress", "largest tension", "N/m", 0.0, 100.0, 0.0},
    Quantity{"curvature", "mean curvature", "1/m", 0.0, 100.0, 0.0},
    Quantity{"speed", "speed", "m/s", 0.0, 2.0, 0.0},
    Quantity{"level", "refinement level", "1", 0.0, 4.0, 0.0},
};

/// Index into k_quantities, or -1.
constexpr int find_quantity(std::string_view name) {
    for (std::size_t i = 0; i < k_quantities.size(); ++i) {
        if (k_quantities[i].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

/// The names of k_quantities in their order.
inline constexpr auto k_quantity_names = [] {
    std::array<std::string_view, k_quantities.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) {
        names[i] = k_quantities[i].name;
    }
    return names;
}();

} // namespace weft
