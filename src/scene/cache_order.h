#pragma once

#include "scene/mesh_import.h"

namespace weft {

/// Which point of a point cache each vertex (#V) of an imported mesh follows. Caches have the
/// file's own order of vertices: for OBJ that of its `v` lines, for PLY, OFF and glTF the order of
/// import. Vertices that welding joined follow the first of them.
///
/// @param file    the mesh file, its name in messages in source.file
/// @param points  in the cache
/// @param cache   its name in messages
/// Throws Error (BadInput), naming both counts, when the cache has another number of points.
std::vector<Index> cache_order(const std::filesystem::path& file,
                               const MeshSource& source,
                               const ImportedMesh& imported,
                               std::size_t points,
                               const std::string& cache);

} // namespace weft
