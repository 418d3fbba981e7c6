#pragma once

#include "geometry/triangle_mesh.h"

#include <span>
#include <vector>

namespace weft {

/// The result of orient_consistently().
struct OrientReport {
    std::vector<Index> flipped; ///< triangles whose corner order was reversed, ascending
    bool is_orientable = true;  ///< false: a part has one side only (a Moebius strip)
};

/// Gives the triangles of each part one outer side: neighbours across an edge of exactly two
/// triangles run along it in opposite directions. The smaller group of a part is reversed (the one
/// without its first triangle when both are equal). A part that cannot be oriented is left as it
/// is.
///
/// @param triangles  in and out: corners 1 and 2 of a flipped one change places
OrientReport orient_consistently(std::vector<Triangle>& triangles);

/// Signed volume that a closed, consistently wound mesh encloses, m^3; negative when inside out.
double enclosed_volume(std::span<const Vec3> positions, std::span<const Triangle> triangles);

/// Turns the triangles of each connected part of a closed mesh that does not cross itself: outward,
/// but those of a part that lies within an odd number of others inward, so that it bounds a cavity.
/// Triangles within a part must be wound alike.
void orient_parts(TriangleMesh& mesh);

/// The same surface with no edge longer than `longest` (m): longer ones are halved, with all
/// triangles beside them, until none is left. Vertices keep their numbers, new ones follow.
TriangleMesh split_long_edges(TriangleMesh mesh, double longest);

} // namespace weft
