#pragma once

#include "patch.h"

namespace weft {

/// The zero set of `field` inside the box, by marching tetrahedra (Doi and Koide 1991) on cubes of
/// side `spacing`, m. Triangles face the positive side. The mesh is manifold, and open only where
/// the surface leaves the box. Its triangles are badly shaped; remesh them.
Patch extract_isosurface(const Field& field,
                         const Vec3& box_min,
                         const Vec3& box_max,
                         double spacing);

} // namespace weft
