#pragma once

#include "base/eigen.h"
#include "frames/frame.h"
#include "geometry/extent.h"
#include "scene/params.h"

#include <array>
#include <span>
#include <vector>

namespace weft {

using Mat4f = Eigen::Matrix4f;

/// Which objects of a frame the picture is about: all that moves by forces, and each obstacle that
/// does not dwarf it (an obstacle whose diagonal is more than k_dwarfs times the rest is a floor or
/// a room). One a frame object.
std::vector<bool> subject_objects(const Frame& frame);
inline constexpr double k_dwarfs = 4.0;

/// Box around these objects; empty when nothing has vertices.
Box3 subject_bounds(const Frame& frame);

/// Box around the vertices of one object; empty when it has none.
Box3 object_bounds(const FrameObject& object);

/// A three-quarter view from the front (+z), slightly from the right and above, that keeps all
/// points in a picture of this size (pixels) with a margin, more on the right, where the legend
/// stands; vertical field of view 35 degrees. Nothing, or a point, is looked at from a metre away.
CameraParams frame_camera(const Extent& extent, const std::array<int, 2>& size);

/// A camera as the renderer uses it: orthonormal axes and the matrix to clip space.
struct Camera {
    Vec3 eye;
    Vec3 right, up, back; ///< world directions, unit; back points from target to eye
    Mat4f view_projection;
};

/// Camera with world y up (z when it looks along y), its depth range fitted to the box.
Camera place_camera(const CameraParams& params, const std::array<int, 2>& size, const Box3& bounds);

/// Pixel position of a world point, from the top left corner; z is > 0 in front of the camera.
Vec3 project(const Camera& camera, const std::array<int, 2>& size, const Vec3& point);

} // namespace weft
