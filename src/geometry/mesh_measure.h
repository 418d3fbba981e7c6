#pragma once

#include "base/eigen.h"
#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// One boundary loop: how many edges, how long.
struct LoopMeasure {
    std::size_t edges = 0;
    double length = 0.0; ///< m
};

/// Size and quality of a mesh, for a person who is about to simulate it. Lengths are in m.
struct MeshMeasure {
    Vec3 low{0.0, 0.0, 0.0}; ///< corner of the bounding box
    Vec3 high{0.0, 0.0, 0.0};
    int parts = 0;
    std::vector<LoopMeasure> loops; ///< longest first
    std::size_t edges = 0;
    double edge_min = 0.0;
    double edge_mean = 0.0;
    double edge_max = 0.0;
    double least_angle = 0.0; ///< rad
    Index least_angle_triangle = k_no_index;
    double least_altitude = 0.0;
    Index least_altitude_triangle = k_no_index;
    double area = 0.0;
    bool is_closed = false;
    double volume = 0.0; ///< m^3; 0 when open

    double largest_dimension() const { return (high - low).maxCoeff(); }
};

/// Measures a mesh; all zero when it has no triangles. Indices must be in range (asserted).
MeshMeasure measure_mesh(const TriangleMesh& mesh);

/// Seams and parts of the flat pattern of a mesh.
struct UvMeasure {
    std::size_t seam_edges = 0; ///< inner edges across which uv jumps
    int islands = 0;            ///< parts of the pattern
};

/// @param corner_uv  #T, uv of each triangle corner
UvMeasure measure_uv(std::span<const Triangle> triangles,
                     std::span<const std::array<Vec2, 3>> corner_uv);

/// Volume and second moments of a body of uniform density inside a closed mesh.
struct MassMoments {
    double volume = 0.0;        ///< m^3; < 0 where the mesh is inside out
    Vec3 centre = Vec3::Zero(); ///< m
    Mat3 second = Mat3::Zero(); ///< mean of r r^T, r from the centre, m^2
};

/// Exact for the mesh: sums over the tetrahedra that its triangles make with one point. The mesh
/// must be closed, and enclose something (volume not 0).
/// Source: Blow and Binstock 2004, inertia of a polyhedron from covariances of tetrahedra.
MassMoments mass_moments(const TriangleMesh& mesh);

/// The cheapest way to each vertex along the edges of a mesh.
struct MeshDistances {
    std::vector<double> cost;  ///< #V; infinite where no start reaches
    std::vector<Index> source; ///< #V, the start vertex of that way; k_no_index where none
};

/// Dijkstra's shortest paths from all vertices at once.
///
/// @param positions  #V, m; an edge costs its length
/// @param start      #V, what it costs to start at a vertex, m; infinite: not there
/// Distances along edges: never too short, on regular meshes up to 8 % too long.
MeshDistances mesh_distances(std::span<const Vec3> positions,
                             std::span<const Triangle> triangles,
                             std::span<const double> start);

} // namespace weft
