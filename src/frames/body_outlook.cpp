#include "frames/body_outlook.h"

#include "frames/landing.h"
#include "frames/motion_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft {

namespace {

constexpr double k_give = 0.25;          // sag of what is not an obstacle, share of its diagonal
constexpr std::size_t k_most_rays = 500; // looks down from a body
constexpr int k_places = 8;              // looked at on the way

/// How far the body falls until it meets an object below, m.
double room_below(const Frame& first, std::size_t number, const Vec3& down) {
    const FrameObject& body = first.objects[number];
    std::vector<Vec3> from;
    const std::size_t stride = body.positions.size() / k_most_rays + 1;
    for (std::size_t v = 0; v < body.positions.size(); v += stride) {
        from.push_back(body.positions[v].cast<double>());
    }
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t o = 0; o < first.objects.size(); ++o) {
        if (o == number) {
            continue;
        }
        FrameObject below = first.objects[o];
        const bool gives = below.kind != ObjectKind::Obstacle;
        const double give = gives ? k_give * object_extent(below).box().diagonal().norm() : 0.0;
        below.kind = ObjectKind::Obstacle;
        for (const double fall : fall_to_obstacles(from, down, std::span(&below, 1))) {
            room = std::min(room, fall + give);
        }
    }
    return room;
}

/// When s = v t + g t^2 / 2 has been fallen, s.
double time_to_fall(double s, double v, double g) {
    if (g <= 0.0) {
        return v > 0.0 ? s / v : std::numeric_limits<double>::infinity();
    }
    return (std::sqrt(v * v + 2.0 * g * s) - v) / g;
}

} // namespace

Extent
body_extent(const Frame& first, std::size_t number, const BodyStart& start, const Scene& scene) {
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
        const double room = room_below(first, number, down);
        seconds = std::min(seconds, time_to_fall(room, velocity.dot(down), gravity));
    }
    for (int k = 1; k <= k_places; ++k) {
        const double t = seconds * k / k_places;
        const Vec3 way = t * velocity + 0.5 * t * t * gravity * down;
        for (const Vec3& x : here.points()) {
            extent.extend(x + way);
        }
    }
    return extent;
}

} // namespace weft
