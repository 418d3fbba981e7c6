#include "frames/landing.h"

#include "base/parallel.h"

#include <algorithm>
#include <limits>

namespace weft {

namespace {

/// A triangle seen along the fall: corners across (x, y) and depth (z).
using Seen = std::array<Vec3, 3>;

/// Depth of the triangle at a place across; infinite beside it or when it is seen from the edge.
double depth_at(const Seen& t, double x, double y) {
    const auto cross = [](double ax, double ay, double bx, double by) { return ax * by - ay * bx; };
    const double area =
        cross(t[1].x() - t[0].x(), t[1].y() - t[0].y(), t[2].x() - t[0].x(), t[2].y() - t[0].y());
    const double w1 = cross(x - t[0].x(), y - t[0].y(), t[2].x() - t[0].x(), t[2].y() - t[0].y());
    const double w2 = cross(t[1].x() - t[0].x(), t[1].y() - t[0].y(), x - t[0].x(), y - t[0].y());
    const double b1 = w1 / area;
    const double b2 = w2 / area;
    const bool inside = area != 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0;
    return inside ? t[0].z() + b1 * (t[1].z() - t[0].z()) + b2 * (t[2].z() - t[0].z())
                  : std::numeric_limits<double>::infinity();
}

} // namespace

std::vector<double> fall_to_obstacles(std::span<const Vec3> points,
                                      const Vec3& down,
                                      std::span<const FrameObject> objects) {
    Mat3 axes;
    axes.row(0) = down.unitOrthogonal();
    axes.row(1) = down.cross(axes.row(0).transpose());
    axes.row(2) = down;
    std::vector<Seen> triangles;
    for (const FrameObject& object : objects) {
        if (object.kind != ObjectKind::Obstacle) {
            continue;
        }
        for (const Triangle& t : object.triangles) {
            Seen seen;
            for (std::size_t k = 0; k < 3; ++k) {
                seen[k] =
                    axes * object.positions[static_cast<std::size_t>(t[k])].cast<double>().eval();
            }
            triangles.push_back(seen);
        }
    }
    std::vector<double> falls(points.size(), std::numeric_limits<double>::infinity());
    parallel_for(
        points.size(),
        [&](std::size_t i) {
            const Vec3 p = axes * points[i];
            for (const Seen& t : triangles) {
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

} // namespace weft
