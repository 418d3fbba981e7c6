#pragma once

#include "base/eigen.h"
#include "scene/object_kind.h"
#include "scene/quantities.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

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
    /// values[q] is #V values of k_quantities[q], smoothed to the vertices. Obstacles and rigid
    /// bodies have none (empty), solids have stretch and speed alone.
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
