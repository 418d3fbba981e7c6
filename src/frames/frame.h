#pragma once

#include "base/eigen.h"
#include "scene/object_kind.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// What can be shown as colour: name in the scene file, words and unit for the legend, and the
/// range used when the scene gives none (stretch takes the fabric's working range instead).
struct Quantity {
    std::string_view name;
    std::string_view title;
    std::string_view unit;
    double low, high;
    double neutral; ///< where a diverging map has its middle
};

inline constexpr std::array<Quantity, 8> k_quantities{{
    {"stretch", "principal stretch", "1", 0.9, 1.2, 1.0},
    {"strain_weft", "strain along weft", "%", -10.0, 10.0, 0.0},
    {"strain_warp", "strain along warp", "%", -10.0, 10.0, 0.0},
    {"shear", "shear angle", "deg", -20.0, 20.0, 0.0},
    {"stress", "largest tension", "N/m", 0.0, 100.0, 0.0},
    {"curvature", "mean curvature", "1/m", 0.0, 100.0, 0.0},
    {"speed", "speed", "m/s", 0.0, 2.0, 0.0},
    {"level", "refinement level", "1", 0.0, 4.0, 0.0},
}};

/// Index into k_quantities, or -1.
constexpr int find_quantity(std::string_view name) {
    for (std::size_t i = 0; i < k_quantities.size(); ++i) {
        if (k_quantities[i].name == name) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

/// Kinds that have values to be shown as colour.
constexpr bool has_quantities(ObjectKind kind) {
    return kind == ObjectKind::Cloth || kind == ObjectKind::Solid;
}

/// One object at one time, in single precision: what leaves the simulation for files and pictures.
struct FrameObject {
    std::string name;
    ObjectKind kind = ObjectKind::Cloth;
    std::string fabric;           ///< name, cloth only
    std::vector<Vec3f> positions; ///< #V, m
    std::vector<Triangle> triangles;
    /// Far points of all places that an obstacle takes during the run when it deforms; else empty
    std::vector<Vec3f> reach;
    std::vector<Vec2f> material_positions; ///< #V, u, m; of cloth only
    /// values[q] is #V values of k_quantities[q], smoothed to the vertices; empty where there are
    /// none: of obstacles and rigid bodies, of solids all but stretch and speed
    std::array<std::vector<float>, k_quantities.size()> values;
};

/// All objects at the time of one frame; pictures and caches are functions of it alone.
struct Frame {
    int number = 1;
    double time = 0.0; ///< s
    std::vector<FrameObject> objects;
    std::vector<Vec3f> problems{}; ///< places of unresolved pairs on the way to it, m
};

} // namespace weft
