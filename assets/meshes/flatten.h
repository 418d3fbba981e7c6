#pragma once

#include "patch.h"

namespace weft {

/// How much a flat pattern differs from the mesh: singular values of the map from pattern to space.
struct Distortion {
    double mean = 0.0; ///< mean over area of max(σ₁, 1/σ₂) − 1
    double worst = 0.0;
};

/// The flat pattern of each panel, laid out next to each other, v upwards.
struct FlatPattern {
    std::vector<Vec2> positions;     ///< m
    std::vector<Triangle> triangles; ///< #T, indices into positions
    Distortion distortion;
};

/// Flattens every connected piece of every panel with as little stretch as possible and turns it so
/// that +v is world +y on the whole. Each piece must be a disk; seen from outside, +v is left of
/// +u.
///
/// Source: Liu et al. 2008, A local/global approach to mesh parameterization (ARAP).
FlatPattern flatten(const Patch& patch);

/// A disk in the plane: u and v are the dot products of the positions with the two axes.
FlatPattern project_flat(const Patch& patch, const Vec3& u_axis, const Vec3& v_axis);

/// Cuts open along the given vertices: triangles whose centroid has x < 0 get copies of the
/// vertices that carry the bit `curve` and lie behind (z < 0).
Patch cut_open_behind(const Patch& patch, unsigned curve);

} // namespace weft
