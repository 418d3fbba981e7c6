#include "state/pin.h"

#include "geometry/closest_points.h"

namespace weft {

namespace {

/// Orthonormal frame of a triangle: along its first edge, across it, normal. Moves with it rigidly.
Mat3 triangle_frame(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    Mat3 frame;
    frame.col(0) = (x1 - x0).normalized();
    frame.col(2) = triangle_normal(x0, x1, x2);
    frame.col(1) = frame.col(2).cross(frame.col(0));
    return frame;
}

Vec3 weigh(const std::array<Vec3, 3>& corners, const Vec3& weights) {
    return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

} // namespace

Anchor anchor_to(const Obstacle& obstacle, Index obstacle_index, const Vec3& position) {
    Anchor anchor;
    anchor.obstacle = obstacle_index;
    const Pose pose = obstacle_pose(obstacle, 0.0);
    const Deformation::Positions shape = obstacle_shape(obstacle, 0.0);
    const auto corner = [&](Index v) { return pose * (*shape)[static_cast<std::size_t>(v)]; };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < obstacle.mesh.triangles.size(); ++t) {
        const Triangle& v = obstacle.mesh.triangles[t];
        const std::array<Vec3, 3> x{corner(v[0]), corner(v[1]), corner(v[2])};
        if (triangle_area(x[0], x[1], x[2]) <= 0.0) {
            continue; // real bodies have some; a frame needs an area
        }
        const Vec3 weights = closest_weights_on_triangle(position, x[0], x[1], x[2]);
        const double distance = (weigh(x, weights) - position).squaredNorm();
        if (distance < nearest) {
            nearest = distance;
            anchor.triangle = static_cast<Index>(t);
            anchor.weights = weights;
        }
    }
    const auto x = obstacle_corners(obstacle, anchor.triangle, 0.0);
    anchor.offset =
        triangle_frame(x[0], x[1], x[2]).transpose() * (position - weigh(x, anchor.weights));
    return anchor;
}

Vec3 pin_position(const Pin& pin,
                  const PinGroup& group,
                  std::span<const Obstacle> obstacles,
                  double t) {
    const Vec3 offset = offset_at(group.move, t);
    if (pin.anchor.obstacle == k_no_index) {
        return pin.start + offset;
    }
    const auto x = obstacle_corners(obstacles[static_cast<std::size_t>(pin.anchor.obstacle)],
                                    pin.anchor.triangle, t);
    return weigh(x, pin.anchor.weights) + triangle_frame(x[0], x[1], x[2]) * pin.anchor.offset +
           offset;
}

} // namespace weft
