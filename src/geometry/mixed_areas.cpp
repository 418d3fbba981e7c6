#include "geometry/mixed_areas.h"

namespace weft {

namespace {

/// edges[k] is the edge opposite to corner k, in any number of dimensions.
template <typename Vec> std::array<double, 3> shares(const std::array<Vec, 3>& edges, double area) {
    std::array<double, 3> cosines{}; // times the lengths of the sides that meet in corner k
    std::array<double, 3> squared{};
    for (std::size_t k = 0; k < 3; ++k) {
        cosines[k] = -edges[(k + 1) % 3].dot(edges[(k + 2) % 3]);
        squared[k] = edges[k].squaredNorm();
    }
    for (std::size_t k = 0; k < 3; ++k) {
        if (cosines[k] < 0.0) {
            std::array<double, 3> result{area / 4, area / 4, area / 4};
            result[k] = area / 2;
            return result;
        }
    }
    if (area <= 0.0) {
        return {0.0, 0.0, 0.0};
    }
    std::array<double, 3> result{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        result[k] = (squared[i] * cosines[i] + squared[j] * cosines[j]) / (16.0 * area);
    }
    return result;
}

} // namespace

std::array<double, 3> mixed_corner_areas(const std::array<Vec2, 3>& corners) {
    const std::array<Vec2, 3> edges{corners[2] - corners[1], corners[0] - corners[2],
                                    corners[1] - corners[0]};
    const double area = 0.5 * std::abs(edges[1].x() * edges[2].y() - edges[1].y() * edges[2].x());
    return shares(edges, area);
}

std::array<double, 3> mixed_corner_areas(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
    return shares(std::array<Vec3, 3>{x2 - x1, x0 - x2, x1 - x0}, triangle_area(x0, x1, x2));
}

std::vector<double> mixed_areas(std::span<const Vec3> positions,
                                std::span<const Triangle> triangles) {
    std::vector<double> areas(positions.size(), 0.0);
    const auto at = [&](Index v) -> const Vec3& { return positions[static_cast<std::size_t>(v)]; };
    for (const Triangle& t : triangles) {
        const auto corner_areas = mixed_corner_areas(at(t[0]), at(t[1]), at(t[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            areas[static_cast<std::size_t>(t[k])] += corner_areas[k];
        }
    }
    return areas;
}

} // namespace weft
