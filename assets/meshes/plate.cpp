#include "plate.h"

#include <cmath>
#include <numbers>

namespace weft {
namespace {

constexpr double k_hole = 0.04; // radius, m
constexpr double k_rim = 0.27;  // radius, m
constexpr double k_half = 0.01; // of the thickness, m
constexpr int k_around = 48;
constexpr int k_lip = 5;   // steps over the lip, as long as those around it
constexpr int k_flat = 13; // rings of the upper side, in proportion to their radius

/// The section that is turned about the y axis: radius and height, m, from the lip's lower end over
/// the lip, outwards on the upper side, over the rim and back on the lower side.
std::vector<Vec2> section() {
    std::vector<Vec2> points;
    const double inner = k_hole + k_half;
    const double outer = k_rim - k_half;
    for (int i = 0; i < k_lip; ++i) {
        const double angle = std::numbers::pi * i / k_lip;
        points.emplace_back(inner - k_half * std::sin(angle), -k_half * std::cos(angle));
    }
    const auto radius = [&](int i) {
        return inner * std::pow(outer / inner, static_cast<double>(i) / k_flat);
    };
    for (int i = 0; i <= k_flat; ++i)
        points.emplace_back(radius(i), k_half);
    points.emplace_back(k_rim, 0.0);
    for (int i = k_flat; i > 0; --i)
        points.emplace_back(radius(i), -k_half);
    return points;
}

} // namespace

ObjMesh make_plate_with_hole() {
    const std::vector<Vec2> ring = section();
    const int count = static_cast<int>(ring.size());
    ObjMesh mesh;
    for (int a = 0; a < k_around; ++a) {
        const double angle = 2.0 * std::numbers::pi * a / k_around;
        for (const Vec2& p : ring)
            mesh.vertices.emplace_back(p.x() * std::cos(angle), p.y(), p.x() * std::sin(angle));
    }
    for (int a = 0; a < k_around; ++a) {
        const int here = a * count;
        const int next = (a + 1) % k_around * count;
        for (int i = 0; i < count; ++i) {
            const int j = (i + 1) % count;
            mesh.triangles.push_back({here + i, next + j, here + j});
            mesh.triangles.push_back({here + i, next + i, next + j});
        }
    }
    return mesh;
}

} // namespace weft
