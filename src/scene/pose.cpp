#include "scene/pose.h"

#include <algorithm>
#include <numbers>

namespace weft {
namespace {

/// Index i of the segment [keys[i], keys[i+1]] that holds t, and how far t is in it, in [0, 1].
template <typename Keys, typename Time>
std::pair<std::size_t, double> find_segment(const Keys& keys, double t, const Time& time_of) {
    std::size_t i = 0;
    while (i + 2 < keys.size() && time_of(keys[i + 1]) <= t) {
        ++i;
    }
    if (keys.size() < 2) {
        return {0, 0.0};
    }
    const double t0 = time_of(keys[i]);
    const double t1 = time_of(keys[i + 1]);
    return {i, t1 > t0 ? std::clamp((t - t0) / (t1 - t0), 0.0, 1.0) : 1.0};
}

} // namespace

Mat3 rotation_from_degrees(const Vec3& rotate_deg) {
    const Vec3 a = rotate_deg * (std::numbers::pi / 180.0);
    return (Eigen::AngleAxisd(a.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(a.y(), Vec3::UnitY()) *
            Eigen::AngleAxisd(a.x(), Vec3::UnitX()))
        .toRotationMatrix();
}

Pose pose_at(std::span<const PoseKey> keys, double t) {
    if (keys.empty()) {
        return {};
    }
    const auto [i, s] = find_segment(keys, t, [](const PoseKey& key) { return key.t; });
    const PoseKey& a = keys[i];
    const PoseKey& b = keys[std::min(i + 1, keys.size() - 1)];
    return {rotation_from_degrees(a.rotate_deg + s * (b.rotate_deg - a.rotate_deg)),
            a.translate + s * (b.translate - a.translate)};
}

Vec3 offset_at(std::span<const std::array<double, 4>> keys, double t) {
    if (keys.empty()) {
        return Vec3::Zero();
    }
    const auto [i, s] =
        find_segment(keys, t, [](const std::array<double, 4>& key) { return key[0]; });
    const auto& a = keys[i];
    const auto& b = keys[std::min(i + 1, keys.size() - 1)];
    const Vec3 from(a[1], a[2], a[3]);
    const Vec3 to(b[1], b[2], b[3]);
    return from + s * (to - from);
}

Vec3 place(const Placement& placement, const Vec3& x) {
    return rotation_from_degrees(placement.rotate_deg) * (placement.scale * x) +
           placement.translate;
}

} // namespace weft
