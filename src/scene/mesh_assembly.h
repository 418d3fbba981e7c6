#pragma once

#include "geometry/mesh_check.h"
#include "scene/mesh_file.h"
#include "scene/mesh_import.h"

namespace weft {

/// Vertices closer than this fraction of the bounding box's diagonal are one vertex. Single
/// precision rounds at 6e-8 of the size, transforms and text add a little: splits of one vertex lie
/// within it, while distinct vertices of a 2 m body that are 2 um apart do not occur.
inline constexpr double k_weld_fraction = 1e-6;

/// A mesh on its way from the file into the simulation, with everything that is wrong with it.
struct MeshAssembly {
    ImportedMesh imported;        ///< welded, converted, repaired and oriented as far as that went
    MeshDefects defects;          ///< what imported.mesh has; after a repair, what is left
    double metres_per_unit = 1.0; ///< what was used
    char up = 'y';                ///< likewise
    std::vector<std::string> refusals;       ///< one line each; empty: fit for an obstacle
    std::vector<std::string> cloth_refusals; ///< what makes it unfit for cloth besides
};

/// Picks objects, converts to metres and y up, welds, repairs and checks.
///
/// Vertex numbers: a vertex is numbered where it first appears in assimp's order, object after
/// object. For PLY, OFF, glTF that is the file's order of vertices; for formats with separate
/// indices for corners (OBJ, FBX, COLLADA, ...) the order in which the faces name them first.
/// Vertices in no triangle get no number.
///
/// @param chosen  indices into file.objects
/// @param name    the file's name in messages
MeshAssembly assemble_mesh(const MeshFile& file,
                           std::vector<std::size_t> chosen,
                           const MeshSource& source,
                           const std::string& name);

} // namespace weft
