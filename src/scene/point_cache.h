#pragma once

#include "base/eigen.h"
#include "scene/mesh_import.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace weft {

/// What the header of a point cache says: positions of the same points, sample after sample.
///
/// PC2 (little-endian): "POINTCACHE2\0", int32 version 1, int32 points, float first frame, float
/// frames a sample, int32 samples; then samples x points x 3 floats.
/// MDD (big-endian): int32 samples, int32 points, float times in s; then the same floats.
struct PointCache {
    std::filesystem::path file;
    std::string name; ///< in messages
    std::size_t points = 0, samples = 0;
    std::vector<double> times; ///< when each sample is, s, ascending; PC2: from the rate asked for
    std::uint64_t first_byte = 0; ///< where the samples begin in the file
    bool is_big_endian = false;
};

/// Reads the header of a .pc2 or .mdd file and checks it against the file's size.
///
/// @param fps  frames (of PC2) or samples a second; 0 with MDD: the file's own times
/// Throws Error (BadInput), one line, when it is missing, of neither format, truncated, or its
/// header makes no sense.
PointCache open_point_cache(const std::filesystem::path& file, const std::string& name, double fps);

/// Positions of sample k, #points. Throws Error (Disk) when the file has changed, (BadInput) when a
/// number is not finite.
std::vector<Vec3f> read_sample(const PointCache& cache, std::size_t k);

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
