#pragma once

#include "geometry/triangle_mesh.h"
#include "scene/rig.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace weft {

/// One mesh at one node of a file: node transforms applied, polygons triangulated, vertices as
/// assimp gives them (split along seams and normals), in the file's unit and axes.
struct FileObject {
    std::string name;                 ///< the node's; the mesh's or the file's when that has none
    std::string mesh_name;            ///< the mesh's, may be empty
    std::vector<std::string> parents; ///< names of the nodes above, from the root; for groups
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<Index> face_of_triangle;        ///< polygon in the file's mesh, from 0
    std::size_t faces = 0;                      ///< polygons of three and more corners
    std::vector<std::array<Vec2, 3>> corner_uv; ///< per triangle; empty: none in the file
    std::size_t points_and_lines = 0;           ///< primitives that were left out
    std::vector<Index> bad_faces;               ///< polygons that name a vertex that is not there
};

/// All surfaces of a file, and what the file itself says about its unit and axes.
struct MeshFile {
    std::string format; ///< assimp's words, e.g. "Autodesk FBX Importer"
    std::vector<FileObject> objects;
    std::vector<std::string> warnings;
    bool states_unit = false;        ///< FBX, COLLADA, glTF, Blender
    double metres_per_unit = 1.0;    ///< the file's word; 1 when it has none
    bool states_up = false;          ///< likewise
    Mat3 to_y_up = Mat3::Identity(); ///< turns the file's axes into x right, y up
    char up = 'y';                   ///< the file's up axis: x, y or z
    std::shared_ptr<const Rig> rig;  ///< when the file has animations; parts are the objects
};

/// Reads every surface of a file by assimp.
///
/// @param name  the file's name in messages
/// Throws Error (BadInput), one line, when the file is missing, a folder, empty, truncated, or
/// not readable in any format that assimp knows.
MeshFile read_mesh_file(const std::filesystem::path& file, const std::string& name);

} // namespace weft
