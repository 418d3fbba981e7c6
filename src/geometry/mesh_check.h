#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <string>
#include <vector>

namespace weft {

/// A triangle whose least altitude is below this fraction of the bounding box's diagonal counts as
/// degenerate: its shape is rounding noise in a file of single precision. Larger refuses thin but
/// honest slivers; smaller lets through triangles whose strain cannot be computed.
inline constexpr double k_least_altitude_fraction = 1e-6;

/// The defects of a mesh, by element number; all lists ascending. Checks that need sound input
/// leave out the elements already listed above them.
struct MeshDefects {
    std::vector<Index> not_finite;      ///< vertices with a NaN or infinite coordinate
    std::vector<Index> out_of_range;    ///< triangles that name a vertex that is not there
    std::vector<Index> unused_vertices; ///< vertices in no triangle
    std::vector<Index> degenerate;      ///< triangles with a corner twice, or next to no altitude
    std::vector<Index> duplicates;      ///< triangles with the same corners as an earlier one
    std::vector<std::array<Index, 2>> non_manifold_edges; ///< edges with more than two triangles
    std::vector<std::array<Index, 2>> winding_edges; ///< their two triangles run the same way along
    std::vector<Index> pinched_vertices;             ///< where fans of triangles touch in a point

    /// Nothing that a simulation cannot stand; unused and pinched vertices are harmless.
    bool is_sound() const {
        return not_finite.empty() && out_of_range.empty() && degenerate.empty() &&
               duplicates.empty() && non_manifold_edges.empty() && winding_edges.empty();
    }
};

/// Looks a mesh through. Cost: a few sorts of its edges.
MeshDefects find_defects(std::span<const Vec3> positions, std::span<const Triangle> triangles);
MeshDefects find_defects(const TriangleMesh& mesh);

/// The first few of many element numbers for a message: "3, 7, 9 and 12 more".
std::string first_few(std::span<const Index> numbers);

/// Likewise for edges: "3-7, 3-9 and 12 more".
std::string first_few(std::span<const std::array<Index, 2>> edges);

/// Least altitude of triangle (x0, x1, x2): twice the area over the longest edge, m; 0 for a point.
double least_altitude(const Vec3& x0, const Vec3& x1, const Vec3& x2);

} // namespace weft
