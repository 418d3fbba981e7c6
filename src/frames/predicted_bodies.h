#pragma once

#include "frames/frame.h"
#include "geometry/extent.h"
#include "scene/params.h"
#include "scene/pose.h"

#include <limits>
#include <span>
#include <vector>

namespace weft {

// The parts of predict_bounds() that know no cloth: obstacles, solids, rigid bodies, and what lies
// below a point.

/// A distance where nothing is met.
inline constexpr double k_far = std::numeric_limits<double>::infinity();

/// Points of one object; empty when it has none. Points that are not finite are left out.
Extent object_extent(const FrameObject& object);

/// The far points that a deforming obstacle says it reaches; empty for others.
Extent reach_extent(const FrameObject& object);

/// Times of the frames from `begin` to the end of the run, s; of a long run a sample of them.
std::vector<double> times_of_motion(const Scene& scene, double begin);

/// How an obstacle's key frames move its points from where they are at `begin` to time t (s).
Pose motion_between(const ObstacleParams& obstacle, double begin, double t);

/// How far each point may fall straight along `down` (unit) until it meets an obstacle of the
/// frame, m; infinite: none lies below. One pass over the triangles for all points.
std::vector<double> drop_distances(std::span<const Vec3> points,
                                   const Vec3& down,
                                   std::span<const FrameObject> objects);

/// What an obstacle moves in from `begin` to the end: exact at the frames' times, or its reach when
/// it deforms.
Extent obstacle_bounds(const FrameObject& object,
                       const ObstacleParams& params,
                       const Scene& scene,
                       double begin);

/// How a solid or a rigid body begins.
struct BodyStart {
    Vec3 velocity = Vec3::Zero(); ///< m/s
    std::vector<PinParams> pins;  ///< pins of its particles; with one it stays where they are
};

/// What a body will probably move in: thrown as it starts, without air, until it meets another
/// object below or the run ends. What stops it may give way by a fraction of its own size unless it
/// is an obstacle.
///
/// @param number  of the body among first.objects
Extent
body_bounds(const Frame& first, std::size_t number, const BodyStart& start, const Scene& scene);

} // namespace weft
