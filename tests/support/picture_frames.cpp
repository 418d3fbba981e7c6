#include "support/picture_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::test {

namespace {

/// Two triangles a cell over a grid of (cells + 1)^2 vertices, seen counter-clockwise from +z when
/// rows go up.
void add_grid_triangles(FrameObject& object, int cells) {
    for (Index j = 0; j < cells; ++j) {
        for (Index i = 0; i < cells; ++i) {
            const Index a = j * (cells + 1) + i;
            const Index b = a + cells + 1;
            object.triangles.push_back({a, a + 1, b + 1});
            object.triangles.push_back({a, b + 1, b});
        }
    }
}

Vec3 draped_place(double u, double v) {
    const double r = std::hypot(u, v);
    const double angle = std::atan2(v, u);
    const double radius = 0.315;
    const double cap = 1.35 * radius; // arc length over which the cloth lies on the ball
    const double hanging = std::max(0.0, r - cap);
    const double on_ball = std::min(r, cap) / radius;
    const double deepening = std::max(0.0, r - 0.22);
    const double fold =
        0.16 * (1.0 + std::cos(8.0 * angle + 0.7)) + 0.04 * (1.0 + std::cos(13.0 * angle));
    const double out = radius * std::sin(on_ball) + 0.15 * hanging + deepening * fold + 0.02;
    const double up = radius * std::cos(on_ball) - 0.99 * hanging + 0.012;
    return {out * std::cos(angle), up, out * std::sin(angle)};
}

} // namespace

FrameObject
square_cloth(double side, int cells, const std::function<double(double, double)>& value) {
    FrameObject cloth;
    cloth.name = "square";
    cloth.fabric = "cotton";
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const double u = static_cast<double>(i) / cells;
            const double v = static_cast<double>(j) / cells;
            cloth.positions.push_back(Vec3(side * (u - 0.5), side * (v - 0.5), 0.0).cast<float>());
            for (std::vector<float>& values : cloth.values) {
                values.push_back(static_cast<float>(value(u, v)));
            }
        }
    }
    add_grid_triangles(cloth, cells);
    return cloth;
}

FrameObject draped_cloth(int cells) {
    FrameObject cloth;
    cloth.name = "tablecloth";
    cloth.fabric = "cotton";
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const double u = 1.2 * (static_cast<double>(i) / cells - 0.5);
            const double v = 1.2 * (0.5 - static_cast<double>(j) / cells);
            const double r = std::hypot(u, v);
            const double fold = std::cos(8.0 * std::atan2(v, u) + 0.7);
            const double hanging = std::max(0.0, r - 0.22);
            cloth.positions.push_back(draped_place(u, v).cast<float>());
            const double stretch = 1.0 + 0.14 * std::exp(-r * r / 0.03) + 0.18 * fold * hanging -
                                   0.24 * hanging * hanging;
            for (std::size_t q = 0; q < k_quantities.size(); ++q) {
                const double share = (stretch - 0.9) / 0.3;
                cloth.values[q].push_back(static_cast<float>(
                    k_quantities[q].low + share * (k_quantities[q].high - k_quantities[q].low)));
            }
        }
    }
    add_grid_triangles(cloth, cells);
    return cloth;
}

FrameObject ball(double radius, int cells) {
    FrameObject object;
    object.name = "ball";
    object.kind = ObjectKind::Obstacle;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const double down = std::numbers::pi * j / cells;
            const double round = 2.0 * std::numbers::pi * i / cells;
            object.positions.push_back(
                (radius * Vec3(std::sin(down) * std::sin(round), std::cos(down),
                               std::sin(down) * std::cos(round)))
                    .cast<float>());
        }
    }
    add_grid_triangles(object, cells);
    for (Triangle& t : object.triangles) {
        std::swap(t[1], t[2]); // rows go down
    }
    return object;
}

FrameObject box(const Vec3& centre, const Vec3& half_size) {
    FrameObject object;
    object.name = "box";
    object.kind = ObjectKind::Obstacle;
    for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                        (i & 4) != 0 ? 1.0 : -1.0);
        object.positions.push_back((centre + sign.cwiseProduct(half_size)).cast<float>());
    }
    const std::array<std::array<Index, 4>, 6> sides{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& [a, b, c, d] : sides) {
        object.triangles.push_back({a, b, c});
        object.triangles.push_back({a, c, d});
    }
    return object;
}

} // namespace weft::test
