#pragma once

#include "scene/params.h"

#include <span>

namespace weft {

/// Rotation about x, then y, then z (world axes), degrees.
Mat3 rotation_from_degrees(const Vec3& rotate_deg);

/// A rigid pose: x -> rotation * x + translation.
struct Pose {
    Mat3 rotation = Mat3::Identity();
    Vec3 translation = Vec3::Zero();

    Vec3 operator*(const Vec3& x) const { return rotation * x + translation; }
};

/// Pose at time t (s) of key frames, linear in translation and in each angle between them (so that
/// 0 to 720 degrees are two turns), constant before the first and after the last; identity for
/// none.
Pose pose_at(std::span<const PoseKey> keys, double t);

/// Offset at time t of pin key frames (t, x, y, z), piecewise linear, constant outside; zero for
/// none.
Vec3 offset_at(std::span<const std::array<double, 4>> keys, double t);

/// Places a point: scale, then rotate, then translate.
Vec3 place(const Placement& placement, const Vec3& x);

} // namespace weft
