#pragma once

#include "geometry/shapes.h"
#include "scene/mesh_import.h"
#include "state/obstacle.h"

#include <filesystem>
#include <functional>

/// Reads the meshes of a scene's objects, or makes those that the scene describes by numbers. All
/// file access of the way from a scene to a world is here; the builders (build_world.h) are pure.
namespace weft {

/// Receives one line for the user.
using Warn = std::function<void(const std::string&)>;

/// All four throw Error (BadInput) naming the file. `warn` gets a line for each defect that does
/// not stop the import.
ImportedMesh
import_cloth(const ClothParams& params, const std::filesystem::path& base_dir, const Warn& warn);

/// The surface; empty for a box, which add_solid() fills by its numbers alone.
ImportedMesh
import_solid(const SolidParams& params, const std::filesystem::path& base_dir, const Warn& warn);

ImportedMesh
import_rigid(const RigidParams& params, const std::filesystem::path& base_dir, const Warn& warn);

/// The mesh of an obstacle and the motion of its vertices.
struct ImportedObstacle {
    TriangleMesh mesh;
    std::shared_ptr<const Deformation> deformation = nullptr; ///< null: its shape is constant
};

/// The deformation comes from an animation in the mesh's file, from numbered files, or from a point
/// cache. Every file is read once here, so that a broken one is refused before the run.
///
/// @param fps  frame rate of the scene, 1/s, for sequences and caches that state none
ImportedObstacle import_obstacle(const ObstacleParams& params,
                                 const std::filesystem::path& base_dir,
                                 double fps,
                                 const Warn& warn);

/// A flat sheet in the plane z = 0 as if it had been imported: without uv, so that weft lies along
/// x and warp along y; each triangle is a polygon of its own.
ImportedMesh imported(const Sheet& sheet);

} // namespace weft
