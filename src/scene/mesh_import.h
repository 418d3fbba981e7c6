#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/mesh_file.h"
#include "scene/params.h"
#include "scene/rig.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace weft {

/// A mesh as the simulation wants it: welded, in metres, y up, in the file's own place.
struct ImportedMesh {
    TriangleMesh mesh;
    /// uv of each triangle corner (texture units, not yet metres); empty when the file has none.
    std::vector<std::array<Vec2, 3>> corner_uv;
    std::vector<Index> polygons;       ///< #T: those cut from one polygon have the same number
    std::size_t vertices_in_file = 0;  ///< as assimp gave them, split along seams and normals
    std::size_t triangles_in_file = 0; ///< after triangulation, before repair
    std::size_t triangles_removed = 0; ///< degenerate ones that `repair` dropped
    std::vector<std::string> objects;  ///< the names that were taken, in the file's order
    std::vector<std::string> warnings; ///< one line each, to be shown to the user
    std::vector<SourceVertex> sources; ///< #V, where each vertex stands in the file
    Mat3 to_world = Mat3::Identity();  ///< from the file's unit and axes, about its origin
    std::shared_ptr<const Rig> rig;    ///< when the file has animations
};

/// Indices of the objects that `wanted` names, in the file's order; all when `wanted` is empty. A
/// name is a node's (a node without a surface of its own stands for all below it) or a mesh's.
///
/// Throws Error (BadInput) for a name that the file does not have, naming the nearest it has.
std::vector<std::size_t>
choose_objects(const MeshFile& file, std::span<const std::string> wanted, const std::string& name);

/// The animation of an imported mesh that `wanted` names; the first when it is empty; null when
/// there is none, when it is "none", or when it moves nothing of what was imported.
///
/// @param file  the file's name in messages
/// Throws Error (BadInput) for a name that the file does not have, naming those it has.
const Animation*
choose_animation(const ImportedMesh& mesh, const std::string& wanted, const std::string& file);

/// Whether an animation moves any of the vertices.
bool animates(const Rig& rig, const Animation& animation, std::span<const SourceVertex> vertices);

/// Reads a mesh file by assimp: node transforms applied, polygons triangulated, vertices welded by
/// position, unit and up axis converted, winding made consistent.
///
/// Vertices within 1e-6 of the bounding box's diagonal become one, across all objects taken, so
/// that parts of one garment are sewn where they meet. They are numbered in the order in which
/// assimp first names them: the file's own for PLY, OFF and glTF, that of the faces' corners for
/// OBJ, FBX, COLLADA and STL. Unit and axes that the file states (FBX, COLLADA, glTF, Blender) hold
/// unless `source` gives others.
///
/// @param file      path as it can be opened
/// @param source    object names, unit, up axis, repair; `source.file` names it in messages
/// @param cloth     true: non-manifold edges are refused too
/// Throws Error (BadInput) in one line naming file, object and element numbers when the file is
/// missing, empty, truncated, has no triangles, indices out of range, coordinates that are not
/// finite, or degenerate triangles without `repair`; `weft inspect` lists all of it.
ImportedMesh import_mesh(const std::filesystem::path& file, const MeshSource& source, bool cloth);

} // namespace weft
