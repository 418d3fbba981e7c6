#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// An inset of a surface: each vertex moves along its inward normal, by its own limit at most.
struct Inset {
    std::vector<Vec3> inward;  ///< #V, unit; zero where there is no normal
    std::vector<double> limit; ///< #V, m, >= 0

    /// Displacement of a vertex when the surface is drawn in by `depth` (m).
    Vec3 displacement(std::size_t vertex, double depth) const {
        return std::min(depth, limit[vertex]) * inward[vertex];
    }
};

/// Computes how far a surface can be drawn in, up to `greatest` (m): by less than half its
/// thickness (the distance along the inward normal to the opposite side), by less than turns a
/// triangle over, and nowhere much deeper than beside it. So thin parts (fingers, ears) stay while
/// thick ones give way. An open surface is as thick as `greatest`.
///
/// @param triangles wound counter-clockwise seen from outside
Inset find_inset(std::span<const Vec3> positions,
                 std::span<const Triangle> triangles,
                 double greatest);

} // namespace weft
