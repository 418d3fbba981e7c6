#pragma once

#include "base/eigen.h"

#include <vector>

namespace weft {

using Box3 = Eigen::AlignedBox3d;

/// Bounds of a set of points: the farthest point in each of some hundred fixed directions, the axes
/// among them. Closer to the convex hull than a box, and as easily merged: what turns in a
/// box touches few of its corners.
class Extent {
public:
    Extent();
    /// The extent of the eight corners; empty for an empty box. Not explicit: a box is an extent.
    Extent(const Box3& box);

    void extend(const Vec3& x);
    void extend(const Extent& other);

    bool is_empty() const { return points_.empty(); }
    /// The farthest points, one a direction (some more than once); none when empty. m
    const std::vector<Vec3>& points() const { return points_; }
    /// The smallest box, exact.
    Box3 box() const;

    /// Distance by which this reaches beyond `other`, the most over all directions, m; <= 0: not at
    /// all. Both must hold points.
    double excess_over(const Extent& other) const;
    /// The same straight down (-y) alone.
    double excess_below(const Extent& other) const;

private:
    std::vector<Vec3> points_;  ///< one a direction, or none
    std::vector<double> reach_; ///< along its direction, m
};

} // namespace weft
