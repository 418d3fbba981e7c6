#include "geometry/triangle_pieces.h"

#include <cassert>

namespace weft {

namespace {

/// The part where sign * (x[axis] - bound) >= 0, by Sutherland and Hodgman 1974.
PiecePolygon cut(const PiecePolygon& polygon, int axis, double bound, double sign) {
    PiecePolygon part;
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const Vec3& a = polygon.corners[k];
        const Vec3& b = polygon.corners[(k + 1) % polygon.count];
        const double at_a = sign * (a[axis] - bound);
        const double at_b = sign * (b[axis] - bound);
        if (at_a >= 0.0) {
            assert(part.count < part.corners.size());
            part.corners[part.count++] = a;
        }
        if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0)) {
            assert(part.count < part.corners.size());
            Vec3 between = a + at_a / (at_a - at_b) * (b - a);
            between[axis] = bound;
            part.corners[part.count++] = between;
        }
    }
    return part;
}

} // namespace

PiecePolygon cut_to_slab(const PiecePolygon& polygon, int axis, double low, double high) {
    const PiecePolygon above = cut(polygon, axis, low, 1.0);
    return cut(above, axis, high, -1.0);
}

} // namespace weft
