#pragma once

#include "patch.h"

namespace weft {

/// Options of the isotropic remeshing.
struct RemeshParams {
    int passes = 24;        ///< rounds of split, collapse, flip and smooth, >= 1
    int settle_passes = 20; ///< last rounds that only flip (Delaunay) and smooth
};

/// Remeshes to nearly equilateral triangles on the zero set of `surface` with edges of
/// `edge_length` (m, a field over space). A vertex with a curve bit k also stays on `limits[k]`;
/// one with two bits is a corner and stays where it is. Borders and seams between panels stay
/// borders and seams. No inner edge of the result joins two vertices of one curve, so the patch can
/// be mirrored there.
///
/// Source: Botsch and Kobbelt 2004, A remeshing approach to multiresolution modeling, section 4.
void remesh(Patch& patch,
            const Field& surface,
            const std::vector<Field>& limits,
            const Field& edge_length,
            const RemeshParams& params = {});

} // namespace weft
