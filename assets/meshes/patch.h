#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <functional>
#include <vector>

namespace weft {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using VertexIndex = int;
using Triangle = std::array<VertexIndex, 3>;

/// A scalar field over space; its zero set is a surface, negative inside (or on the side kept).
using Field = std::function<double(const Vec3&)>;

/// A triangle mesh under construction, one part of which may later be mirrored.
///
/// `curves` holds, per vertex, one bit for each limiting field it must stay on (a cut, a seam).
/// `panels` holds, per triangle, the piece of the flat pattern it belongs to; an edge between two
/// panels is a seam and is kept like a border.
struct Patch {
    std::vector<Vec3> vertices;   ///< m
    std::vector<unsigned> curves; ///< #V
    std::vector<Triangle> triangles;
    std::vector<int> panels; ///< #T
};

/// A finished mesh: world positions, and the places of its corners in the flat pattern if it is
/// cloth.
struct ObjMesh {
    std::vector<Vec3> vertices; ///< m
    std::vector<Triangle> triangles;
    std::vector<Vec2> material_positions;     ///< m; empty for an obstacle
    std::vector<Triangle> material_triangles; ///< indices into material_positions
};

/// Central differences of a field, 1/m times its unit.
Vec3 gradient(const Field& field, const Vec3& position);

/// Cuts the patch where `cut` is zero and drops what lies where it is positive. New vertices get
/// `curve` (one bit), and keep the bits that both ends of a cut border edge have.
Patch clip(const Patch& patch, const Field& cut, unsigned curve);

/// Cuts the patch where `cut` is zero and keeps both sides; on the positive side `added` is added
/// to the panels.
Patch divide(const Patch& patch, const Field& cut, unsigned curve, int added);

/// Adds the mirror image in the plane x = 0, joined at the vertices that carry the bit `curve`.
Patch mirror_x(const Patch& patch, unsigned curve);

/// Drops vertices that no triangle uses and triangles not connected to the largest part.
Patch largest_part(const Patch& patch);

/// Writes with six decimals; a `vt` per corner where the mesh has material positions.
/// Throws std::runtime_error when the file cannot be written.
void write_obj(const std::filesystem::path& path, const ObjMesh& mesh);

/// Reads what write_obj writes. Throws std::runtime_error when the file cannot be read.
ObjMesh read_obj(const std::filesystem::path& path);

} // namespace weft
