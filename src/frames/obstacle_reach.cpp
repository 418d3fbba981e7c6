#include "frames/obstacle_reach.h"

#include "geometry/extent.h"

#include <algorithm>
#include <cmath>

namespace weft {

namespace {

// More of either: slower starts; fewer: pictures that may have to be drawn again.
constexpr double k_most_times = 64.0;
constexpr std::size_t k_most_vertices = 2000;

} // namespace

std::vector<Vec3f> obstacle_reach(const Obstacle& obstacle, double end, double fps) {
    const double steps = std::clamp(std::round(end * fps), 1.0, k_most_times);
    const std::size_t stride = obstacle.mesh.positions.size() / k_most_vertices + 1;
    std::vector<Vec3> positions(obstacle.mesh.positions.size());
    Extent extent;
    for (double step = 0.0; step <= steps; step += 1.0) {
        obstacle_positions(obstacle, end * step / steps, positions);
        for (std::size_t i = 0; i < positions.size(); i += stride) {
            extent.extend(positions[i]);
        }
    }
    std::vector<Vec3f> reach;
    for (const Vec3& x : extent.points()) {
        reach.emplace_back(x.cast<float>());
    }
    return reach;
}

} // namespace weft
