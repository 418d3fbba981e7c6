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

struct Corners {
    Vec3 x0, x1, x2;

    Vec3 at(const Vec3& weights) const {
        return weights[0] * x0 + weights[1] * x1 + weights[2] * x2;
    }
};

Corners corners_of(const Obstacle& obstacle, Index triangle, double t) {
    const Pose pose = obstacle_pose(obstacle, t);
    const Triangle& v = obstacle.mesh.triangles[static_cast<std::size_t>(triangle)];
    const auto at = [&](std::size_t k) {
        return pose * obstacle.mesh.positions[static_cast<std::size_t>(v[k])];
    };
    return {at(0), at(1), at(2)};
}

} // namespace

Anchor anchor_to(const Obstacle& obstacle, Index obstacle_index, const Vec3& position) {
    Anchor anchor;
    anchor.obstacle = obstacle_index;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < obstacle.mesh.triangles.size(); ++t) {
        const Corners c = corners_of(obstacle, static_cast<Index>(t), 0.0);
        if (triangle_area(c.x0, c.x1, c.x2) <= 0.0) {
            continue; // real bodies have some; a frame needs an area
        }
        const Vec3 weights = closest_weights_on_triangle(position, c.x0, c.x1, c.x2);
        const double distance = (c.at(weights) - position).squaredNorm();
        if (distance < nearest) {
            nearest = distance;
            anchor.triangle = static_cast<Index>(t);
            anchor.weights = weights;
        }
    }
    const Corners c = corners_of(obstacle, anchor.triangle, 0.0);
    anchor.offset =
        triangle_frame(c.x0, c.x1, c.x2).transpose() * (position - c.at(anchor.weights));
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
    const Corners c = corners_of(obstacles[static_cast<std::size_t>(pin.anchor.obstacle)],
                                 pin.anchor.triangle, t);
    return c.at(pin.anchor.weights) + triangle_frame(c.x0, c.x1, c.x2) * pin.anchor.offset + offset;
}

} // namespace weft
