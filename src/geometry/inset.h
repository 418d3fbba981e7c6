#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// How a surface is drawn in along its normals: each vertex by its own way at most.
struct Inset {
    std::vector<Vec3> inward;  ///< #V, unit; zero where there is no normal
    std::vector<double> limit; ///< #V, m, >= 0

    /// The way of a vertex when the surface is drawn in by `depth` (m).
    Vec3 way(std::size_t vertex, double depth) const {
        return std::min(depth, limit[vertex]) * inward[vertex];
    }
};

/// How far a surface can be drawn in, up to `greatest` (m): by less than half its thickness, the
/// way along the inward normal to the opposite side, as far as no triangle turns over, and nowhere
/// much deeper than beside it. So thin parts (fingers, ears) stay while thick ones give way. An
/// open surface is as thick as `greatest`.
///
/// @param triangles wound counter-clockwise seen from outside
Inset find_inset(std::span<const Vec3> positions,
                 std::span<const Triangle> triangles,
                 double greatest);

} // namespace weft
