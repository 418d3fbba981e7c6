#pragma once

#include "patch.h"

namespace weft {

/// One cross-section of a loft: an ellipse across the centre line.
struct Station {
    Vec3 centre;       ///< m
    double half_width; ///< along the side axis, m
    double half_depth; ///< across it, m
};

/// What a loft has besides its stations.
struct LoftParams {
    Vec3 side_axis = Vec3::UnitX(); ///< direction of half_width; not along the centre line
    double exponent = 2.0;   ///< of the superellipse; 2 = ellipse, larger = more like a rectangle
    double start_cap = 0.02; ///< how far the first end bulges, m, > 0
    double end_cap = 0.02;   ///< how far the last end bulges, m, > 0
};

/// A solid with smoothly varying elliptic sections along a smooth centre line: a limb, a trunk.
class Loft {
public:
    /// Requires at least two stations with different centres.
    Loft(const std::vector<Station>& stations, const LoftParams& params);

    /// Signed distance, m, negative inside. The zero set is exact; elsewhere first order.
    double distance(const Vec3& position) const;

private:
    std::vector<Station> sections_; ///< the stations, interpolated and close together
    std::vector<Vec3> tangents_;    ///< unit, one per section
    LoftParams params_;
};

/// Signed distance to an ellipsoid with axes along x, y, z; first order away from the surface.
double ellipsoid_distance(const Vec3& position, const Vec3& centre, const Vec3& radii);

/// The lesser of two distances, rounded over `width`, m, where they are about equal.
double smooth_union(double a, double b, double width);

} // namespace weft
