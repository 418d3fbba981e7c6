#include "geometry/contour_gradient.h"

#include <cmath>

namespace weft {

namespace {

/// Sine of the angle between edge and face below which the edge counts as lying in it: its foot
/// point would run away.
constexpr double k_least_slope = 1e-3;

} // namespace

std::optional<Vec3>
contour_gradient(const Vec3& p, const Vec3& q, std::span<const Vec3> apexes, const Vec3& normal) {
    const Vec3 edge = (q - p).normalized();
    double slope = edge.dot(normal);
    slope = std::copysign(std::max(std::abs(slope), k_least_slope), slope);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& apex : apexes) {
        const Vec3 line = edge.cross(apex - p).cross(normal); // the two planes' common direction
        const double length = line.norm();
        if (length <= 0.0) {
            continue;
        }
        const Vec3 inward = (apex - p) - edge.dot(apex - p) * edge;
        const Vec3 contour = std::copysign(1.0 / length, line.dot(inward)) * line;
        sum += contour - 2.0 * edge.dot(contour) / slope * normal;
    }
    const double length = sum.norm();
    return length > 1e-9 ? std::optional<Vec3>(sum / length) : std::nullopt;
}

} // namespace weft
