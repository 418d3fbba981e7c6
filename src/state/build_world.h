#pragma once

#include "scene/params.h"
#include "state/import_objects.h"
#include "state/world.h"

/// Builders of a world at t = 0: parameters and imported meshes in, state out. They read no file.
/// Each appends one object and leaves a world that check() accepts. Objects are added in the order
/// cloths, solids, rigid bodies, obstacles. All throw Error (BadInput) naming the object and key.
namespace weft {

inline void ignore_warning(const std::string& /*line*/) {}

/// Builds rest shape, masses and network of a cloth, placed and moving as `params` says. `warn`
/// gets a line where the uv's unit or the edges' law looks like a slip.
Cloth& add_cloth(World& world,
                 const ClothParams& params,
                 const ImportedMesh& imported,
                 const Warn& warn = ignore_warning);

/// Edges of an imported surface longer than this many spacings are halved, so that the surface
/// bends with the particles that it is embedded in. Larger: corners of flat faces cut through the
/// particles when these are dented; smaller: more triangles in contact than the particles can tell
/// apart.
inline constexpr double k_longest_edge = 1.5;

/// Fills a solid with particles: appends its embedded surface vertices, then its particles. The
/// surface is the box's outside or the imported mesh with long edges halved; sides of the lattice
/// have the stiffness K, diagonals `shear` times that.
///
/// Refuses a mesh that is open (unless `fill = "winding"`) or crosses itself, one with nothing
/// inside, and a lattice of too many cells.
Solid& add_solid(World& world, const SolidParams& params, const ImportedMesh& imported);

/// Refuses a mesh that is open or crosses itself; one that is inside out is turned.
RigidBody& add_rigid(World& world, const RigidParams& params, const ImportedMesh& imported);

/// The mesh of a deforming obstacle stands as at t = 0.
Obstacle& add_obstacle(World& world, const ObstacleParams& params, ImportedObstacle imported);

/// Fills world.attachments, attached_pairs and attached_states. `warn` gets a line where the sides
/// of a seam differ in length.
void build_attachments(World& world,
                       std::span<const AttachParams> params,
                       const Warn& warn = ignore_warning);

/// Imports and adds all objects of a scene one after the other, then pins and attachments.
World build_world(const Scene& scene, const Warn& warn);

} // namespace weft
