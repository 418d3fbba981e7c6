#include "geometry/separation.h"

#include "geometry/closest_points.h"

#include <limits>

namespace weft {

Separation separation(PairKind kind, const PairPoints& x) {
    Separation result;
    if (kind == PairKind::VertexFace) {
        const Vec3 w = closest_weights_on_triangle(x[0], x[1], x[2], x[3]);
        result.weights = {1.0, -w[0], -w[1], -w[2]};
        // Differences first: far from the origin the weighted sum would lose digits.
        result.normal = x[0] - x[1] - w[1] * (x[2] - x[1]) - w[2] * (x[3] - x[1]);
    } else {
        const Vec2 p = closest_weights_on_segments(x[0], x[1], x[2], x[3]);
        result.weights = {1.0 - p[0], p[0], -(1.0 - p[1]), -p[1]};
        result.normal = x[0] - x[2] + p[0] * (x[1] - x[0]) - p[1] * (x[3] - x[2]);
    }
    result.distance = result.normal.norm();
    if (result.distance > 0.0) {
        result.normal /= result.distance;
    }
    return result;
}

double gap_along(PairKind kind, const PairPoints& x, const Vec3& n) {
    const std::size_t split = first_side(kind);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < split; ++i) {
        for (std::size_t j = split; j < 4; ++j) {
            least = std::min(least, n.dot(x[i] - x[j]));
        }
    }
    return least;
}

} // namespace weft
