#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace weft {

namespace {

constexpr double k_azimuth = 24.0 * std::numbers::pi / 180.0;   // to the right of +z
constexpr double k_elevation = 13.0 * std::numbers::pi / 180.0; // above the horizon
constexpr double k_filled = 0.88;     // fraction of the half height that the subject may take
constexpr double k_left = 0.88;       // fraction of the half width to the left ...
constexpr double k_right = 0.70;      // and to the right, where the legend stands
constexpr double k_least_size = 1e-3; // m; a smaller box is seen as one of a metre

double half_angle(double fov_deg) {
    return 0.5 * fov_deg * std::numbers::pi / 180.0;
}

struct Axes {
    Vec3 right, up, back;
};

Axes axes_towards(const Vec3& back_direction) {
    Axes axes;
    axes.back = back_direction.normalized();
    axes.right = Vec3::UnitY().cross(axes.back);
    if (axes.right.norm() < 1e-6) { // looking straight up or down
        axes.right = Vec3::UnitX();
    }
    axes.right.normalize();
    axes.up = axes.back.cross(axes.right);
    return axes;
}

/// How far away, and how far beside a middle, an eye must be that looks along -back and
/// shall see all points within two planes, at these tangents below and above the line of sight.
class View {
public:
    View(const std::vector<Vec3>& points,
         const Vec3& middle,
         const Vec3& axis,
         const Vec3& back,
         double tan_low,
         double tan_high)
        : tan_low_(tan_low), tan_high_(tan_high) {
        for (const Vec3& point : points) {
            const double x = axis.dot(point - middle);
            const double z = back.dot(point - middle);
            high_ = std::max(high_, x + z * tan_high); // x - shift <= (distance - z) tan_high
            low_ = std::min(low_, x - z * tan_low);    // shift - x <= (distance - z) tan_low
        }
    }

    double least_distance() const { return (high_ - low_) / (tan_low_ + tan_high_); }
    /// So that the points stand in the middle of the picture, or as near to that as the planes
    /// allow.
    double shift(double distance) const {
        return std::max(high_ - distance * tan_high_,
                        std::min(0.5 * (low_ + high_), low_ + distance * tan_low_));
    }

private:
    double tan_low_, tan_high_;
    double low_ = std::numeric_limits<double>::infinity();
    double high_ = -std::numeric_limits<double>::infinity();
};

} // namespace

Box3 object_bounds(const FrameObject& object) {
    Box3 box;
    for (const Vec3f& x : object.positions) {
        if (x.allFinite()) {
            box.extend(x.cast<double>());
        }
    }
    return box;
}

std::vector<bool> subject_objects(const Frame& frame) {
    std::vector<bool> counts(frame.objects.size(), false);
    Box3 subject;
    std::vector<std::pair<Box3, std::size_t>> obstacles;
    for (std::size_t i = 0; i < frame.objects.size(); ++i) {
        const Box3 box = object_bounds(frame.objects[i]);
        if (box.isEmpty()) {
            continue;
        }
        if (frame.objects[i].kind != ObjectKind::Obstacle) {
            counts[i] = true;
            subject.extend(box);
        } else {
            obstacles.emplace_back(box, i);
        }
    }
    std::stable_sort(obstacles.begin(), obstacles.end(), [](const auto& a, const auto& b) {
        return a.first.diagonal().squaredNorm() < b.first.diagonal().squaredNorm();
    });
    for (const auto& [box, i] : obstacles) {
        if (subject.isEmpty() || box.diagonal().norm() <= k_dwarfs * subject.diagonal().norm()) {
            counts[i] = true;
            subject.extend(box);
        }
    }
    return counts;
}

Box3 subject_bounds(const Frame& frame) {
    const std::vector<bool> counts = subject_objects(frame);
    Box3 subject;
    for (std::size_t i = 0; i < frame.objects.size(); ++i) {
        if (counts[i]) {
            subject.extend(object_bounds(frame.objects[i]));
        }
    }
    return subject;
}

CameraParams frame_camera(const Extent& extent, const std::array<int, 2>& size) {
    const double diagonal = extent.is_empty() ? 0.0 : extent.box().diagonal().norm();
    if (diagonal < k_least_size) {
        const Vec3 middle = extent.is_empty() ? Vec3::Zero().eval() : extent.box().center();
        return frame_camera(Box3(middle - Vec3::Constant(0.25), middle + Vec3::Constant(0.25)),
                            size);
    }
    const Vec3 middle = extent.box().center();
    CameraParams camera;
    const Axes axes =
        axes_towards(Vec3(std::sin(k_azimuth) * std::cos(k_elevation), std::sin(k_elevation),
                          std::cos(k_azimuth) * std::cos(k_elevation)));
    const double tan_up = std::tan(half_angle(camera.fov_deg));
    const double tan_right = tan_up * size[0] / size[1];
    const View across(extent.points(), middle, axes.right, axes.back, k_left * tan_right,
                      k_right * tan_right);
    const View upright(extent.points(), middle, axes.up, axes.back, k_filled * tan_up,
                       k_filled * tan_up);
    const double distance = std::max(across.least_distance(), upright.least_distance());
    camera.target =
        middle + across.shift(distance) * axes.right + upright.shift(distance) * axes.up;
    camera.eye = camera.target + distance * axes.back;
    return camera;
}

Camera
place_camera(const CameraParams& params, const std::array<int, 2>& size, const Box3& bounds) {
    Camera camera;
    camera.eye = params.eye;
    const Vec3 back = params.eye - params.target;
    const Axes axes = axes_towards(back.norm() > 0.0 ? back : Vec3::UnitZ().eval());
    camera.right = axes.right;
    camera.up = axes.up;
    camera.back = axes.back;

    double farthest = std::max(back.norm(), 1e-3);
    double nearest = farthest;
    if (!bounds.isEmpty()) {
        const double radius = 0.5 * bounds.diagonal().norm();
        const double depth = axes.back.dot(params.eye - bounds.center());
        farthest = std::max(farthest, depth + 8.0 * radius); // the floor reaches behind the subject
        nearest = std::min(nearest, depth - radius);
    }
    nearest = std::max(nearest * 0.5, farthest * 1e-3);

    const double up_scale = 1.0 / std::tan(half_angle(params.fov_deg));
    const double right_scale = up_scale * size[1] / size[0];
    Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
    projection(0, 0) = right_scale;
    projection(1, 1) = up_scale;
    projection(2, 2) = (farthest + nearest) / (nearest - farthest);
    projection(2, 3) = 2.0 * farthest * nearest / (nearest - farthest);
    projection(3, 2) = -1.0;
    Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
    view.block<1, 3>(0, 0) = axes.right.transpose();
    view.block<1, 3>(1, 0) = axes.up.transpose();
    view.block<1, 3>(2, 0) = axes.back.transpose();
    view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * params.eye;
    camera.view_projection = (projection * view).cast<float>();
    return camera;
}

Vec3 project(const Camera& camera, const std::array<int, 2>& size, const Vec3& point) {
    const Eigen::Vector4d clip =
        camera.view_projection.cast<double>() * Eigen::Vector4d(point.x(), point.y(), point.z(), 1);
    return {(0.5 + 0.5 * clip.x() / clip.w()) * size[0],
            (0.5 - 0.5 * clip.y() / clip.w()) * size[1], clip.w()};
}

} // namespace weft
