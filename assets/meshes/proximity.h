#pragma once

#include <unordered_map>

#include "patch.h"

namespace weft {

/// Triangles of a mesh in the cells of a grid, to find those near a box.
class TriangleGrid {
public:
    TriangleGrid(const ObjMesh& mesh, double cell_size);

    /// Triangles whose box may meet the given one; each once, in order.
    std::vector<int> find(const Vec3& low, const Vec3& high) const;

private:
    template <class Visit> void for_cells(const Vec3& low, const Vec3& high, Visit visit) const;

    double cell_size_;
    std::unordered_map<long long, std::vector<int>> cells_;
};

/// Number of pairs (edge of a, triangle of b) that cross, for edges that share no vertex with the
/// triangle. With a and b the same mesh: its self-intersections.
int count_crossings(const ObjMesh& a, const ObjMesh& b, bool is_same);

/// Least distance between the two surfaces, m, or `farthest` if it is more than that.
double least_distance(const ObjMesh& a, const ObjMesh& b, double farthest);

/// Distance from a point to the surface, m, or `farthest` if it is more than that.
double
point_distance(const Vec3& point, const ObjMesh& mesh, const TriangleGrid& grid, double farthest);

/// Turns of the closed mesh around the point: 1 inside, 0 outside (Jacobson et al. 2013).
double winding_number(const Vec3& point, const ObjMesh& mesh);

} // namespace weft
