#include "frames/predicted_bodies.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {

namespace {

constexpr double k_sag = 0.25;                // sag of what is not an obstacle over its diagonal
constexpr std::size_t k_most_body_rays = 500; // looks down from a body
constexpr std::size_t k_most_times = 400;     // places of an obstacle on its path
constexpr int k_places = 8;                   // samples on the path of a falling body

/// A triangle in axes whose z points down: corners across (x, y) and their depth (z).
using DownTriangle = std::array<Vec3, 3>;

/// Depth of the triangle at a place across; infinite beside it or when it stands upright.
double depth_at(const DownTriangle& t, double x, double y) {
    const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    const double area =
        cross(t[1].x() - t[0].x(), t[1].y() - t[0].y(), t[2].x() - t[0].x(), t[2].y() - t[0].y());
    const double w1 = cross(x - t[0].x(), y - t[0].y(), t[2].x() - t[0].x(), t[2].y() - t[0].y());
    const double w2 = cross(t[1].x() - t[0].x(), t[1].y() - t[0].y(), x - t[0].x(), y - t[0].y());
    const double b1 = w1 / area;
    const double b2 = w2 / area;
    const bool inside = area != 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    return inside ? t[0].z() + b1 * (t[1].z() - t[0].z()) + b2 * (t[2].z() - t[0].z()) : k_far;
}

/// How far the body falls until it meets an object below, m.
double drop_below(const Frame& first, std::size_t number, const Vec3& down) {
    const FrameObject& body = first.objects[number];
    std::vector<Vec3> from;
    const std::size_t stride = body.positions.size() / k_most_body_rays + 1;
    for (std::size_t v = 0; v < body.positions.size(); v += stride) {
        from.push_back(body.positions[v].cast<double>());
    }
    double drop = k_far;
    for (std::size_t o = 0; o < first.objects.size(); ++o) {
        if (o == number) {
            continue;
        }
        FrameObject below = first.objects[o];
        const bool gives = below.kind != ObjectKind::Obstacle;
        const double give = gives ? k_sag * object_extent(below).box().diagonal().norm() : 0.0;
        below.kind = ObjectKind::Obstacle;
        for (const double fall : drop_distances(from, down, std::span(&below, 1))) {
            drop = std::min(drop, fall + give);
        }
    }
    return drop;
}

/// When s = v t + g t^2 / 2 has been fallen, s.
double time_to_fall(double s, double v, double g) {
    if (g <= 0.0) {
        return v > 0.0 ? s / v : k_far;
    }
    return (std::sqrt(v * v + 2.0 * g * s) - v) / g;
}

} // namespace

Extent object_extent(const FrameObject& object) {
    Extent extent;
    for (const Vec3f& x : object.positions) {
        if (x.allFinite()) {
            extent.extend(x.cast<double>());
        }
    }
    return extent;
}

Extent reach_extent(const FrameObject& object) {
    Extent extent;
    for (const Vec3f& x : object.reach) {
        extent.extend(x.cast<double>());
    }
    return extent;
}

std::vector<double> times_of_motion(const Scene& scene, double begin) {
    const double end = (scene.scene.frames - 1) / scene.scene.fps;
    const double frames = std::max(0.0, std::round((end - begin) * scene.scene.fps));
    const auto steps = std::min(k_most_times, static_cast<std::size_t>(frames));
    std::vector<double> times{begin};
    for (std::size_t i = 1; i <= steps; ++i) {
        times.push_back(begin +
                        (end - begin) * static_cast<double>(i) / static_cast<double>(steps));
    }
    return times;
}

Pose motion_between(const ObstacleParams& obstacle, double begin, double t) {
    Pose from = pose_at(obstacle.motion, begin);
    Pose to = pose_at(obstacle.motion, t);
    from.translation += obstacle.placement.translate;
    to.translation += obstacle.placement.translate;
    Pose motion;
    motion.rotation = to.rotation * from.rotation.transpose();
    motion.translation = to.translation - motion.rotation * from.translation;
    return motion;
}

std::vector<double> drop_distances(std::span<const Vec3> points,
                                   const Vec3& down,
                                   std::span<const FrameObject> objects) {
    Mat3 axes;
    axes.row(0) = down.unitOrthogonal();
    axes.row(1) = down.cross(axes.row(0).transpose());
    axes.row(2) = down;
    std::vector<DownTriangle> triangles;
    for (const FrameObject& object : objects) {
        if (object.kind != ObjectKind::Obstacle) {
            continue;
        }
        for (const Triangle& t : object.triangles) {
            DownTriangle turned;
            for (std::size_t k = 0; k < 3; ++k) {
                turned[k] =
                    axes * object.positions[static_cast<std::size_t>(t[k])].cast<double>().eval();
            }
            triangles.push_back(turned);
        }
    }
    std::vector<double> falls(points.size(), k_far);
    parallel_for(
        points.size(),
        [&](std::size_t i) {
            const Vec3 p = axes * points[i];
            for (const DownTriangle& t : triangles) {
                const auto [left, right] = std::minmax({t[0].x(), t[1].x(), t[2].x()});
                if (p.x() < left || p.x() > right) {
                    continue;
                }
                const double fall = depth_at(t, p.x(), p.y()) - p.z();
                if (fall >= 0.0) {
                    falls[i] = std::min(falls[i], fall);
                }
            }
        },
        16);
    return falls;
}

Extent obstacle_bounds(const FrameObject& object,
                       const ObstacleParams& params,
                       const Scene& scene,
                       double begin) {
    const Extent start = object_extent(object);
    Extent extent = start;
    extent.extend(reach_extent(object));
    if (params.motion.empty() || !object.reach.empty()) {
        return extent;
    }
    for (const double t : times_of_motion(scene, begin)) {
        const Pose motion = motion_between(params, begin, t);
        for (const Vec3& x : start.points()) {
            extent.extend(motion * x);
        }
    }
    return extent;
}

Extent
body_bounds(const Frame& first, std::size_t number, const BodyStart& start, const Scene& scene) {
    const Extent here = object_extent(first.objects[number]);
    Extent extent = here;
    const double end = (scene.scene.frames - 1) / scene.scene.fps;
    if (!start.pins.empty()) {
        for (const PinParams& pin : start.pins) {
            for (const auto& key : pin.move) {
                for (const Vec3& x : here.points()) {
                    extent.extend(x + Vec3(key[1], key[2], key[3]));
                }
            }
        }
        return extent;
    }
    const double gravity = scene.scene.gravity.norm();
    const Vec3 down = gravity > 0.0 ? Vec3(scene.scene.gravity / gravity) : Vec3(-Vec3::UnitY());
    const Vec3 velocity = first.number == 1 ? start.velocity : Vec3::Zero().eval();
    double seconds = std::max(0.0, end - first.time);
    if (scene.contact.enabled) {
        const double drop = drop_below(first, number, down);
        seconds = std::min(seconds, time_to_fall(drop, velocity.dot(down), gravity));
    }
    for (int k = 1; k <= k_places; ++k) {
        const double t = seconds * k / k_places;
        const Vec3 displacement = t * velocity + 0.5 * t * t * gravity * down;
        for (const Vec3& x : here.points()) {
            extent.extend(x + displacement);
        }
    }
    return extent;
}

} // namespace weft
