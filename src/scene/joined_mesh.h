#pragma once

#include "scene/mesh_file.h"

#include <span>

namespace weft {

/// Where a triangle came from.
struct TriangleOrigin {
    std::size_t object; ///< in MeshFile::objects
    Index face;         ///< polygon in that object's mesh, from 0
    bool operator==(const TriangleOrigin&) const = default;
};

/// Objects of a file behind one another in one mesh; the arrays by triangle stay in step.
struct JoinedMesh {
    TriangleMesh mesh;
    std::vector<std::array<Vec2, 3>> corner_uv; ///< empty unless every object has uv
    std::vector<TriangleOrigin> origins;
    std::vector<SourceVertex> sources; ///< #V, the first vertex in the file that it stands for
};

/// Joins the objects `chosen` of a file.
///
/// @param to_world  turns and scales a position of the file, about its origin
JoinedMesh
join_objects(const MeshFile& file, std::span<const std::size_t> chosen, const Mat3& to_world);

/// Drops vertices that no triangle uses, keeping the order of the others; returns how many.
std::size_t drop_unused_vertices(JoinedMesh& joined);

/// Joins vertices within `tolerance` (m) of one another; see weld_vertices(). Those of objects in
/// different groups stay apart.
///
/// @param groups  one an object of the file; empty: all are one
void weld_mesh(JoinedMesh& joined, double tolerance, std::span<const Index> groups = {});

/// Drops triangles by number; `numbers` ascending and unique.
void drop_triangles(JoinedMesh& joined, std::span<const Index> numbers);

/// Numbers, from 0, of the polygons that triangles were cut from.
std::vector<Index> polygon_numbers(const JoinedMesh& joined);

/// Lets the uv of a triangle follow when its corners 1 and 2 change places.
void flip_corner_uv(JoinedMesh& joined, std::size_t triangle);

} // namespace weft
