#pragma once

#include "scene/mesh_assembly.h"
#include "scene/params.h"

#include <filesystem>
#include <string>

namespace weft {

/// What `weft inspect` says about one file.
struct InspectReport {
    std::string text;        ///< aligned lines, each with its end
    bool is_refused = false; ///< a simulation would refuse it
};

/// Reads a mesh file and describes it: objects, counts, size, boundary, shape of the triangles, uv,
/// defects with element numbers, warnings. A file that cannot be read yields a report that says so.
///
/// @param source    unit, up axis, objects and repair, as in a scene
/// @param as_cloth  what only cloth refuses counts as refused too
InspectReport
describe_mesh_file(const std::filesystem::path& file, const MeshSource& source, bool as_cloth);

} // namespace weft
