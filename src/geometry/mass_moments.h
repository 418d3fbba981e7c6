#pragma once

#include "geometry/triangle_mesh.h"

namespace weft {

/// What a body of uniform density has inside a closed mesh.
struct MassMoments {
    double volume = 0.0;        ///< m^3; < 0 where the mesh is inside out
    Vec3 centre = Vec3::Zero(); ///< m
    Mat3 second = Mat3::Zero(); ///< mean of r r^T, r from the centre, m^2
};

/// Exact for the mesh: sums over the tetrahedra that its triangles make with one point. The mesh
/// must be closed, and enclose something (volume not 0).
/// Source: Blow and Binstock 2004, inertia of a polyhedron from covariances of tetrahedra.
MassMoments mass_moments(const TriangleMesh& mesh);

} // namespace weft
