#include "geometry/sheet.h"

#include <cmath>
#include <random>

namespace weft {

namespace {

Sheet grid(int nx, int ny, double width, double height, const std::function<bool(int, int)>& swap) {
    Sheet sheet;
    for (int j = 0; j <= ny; ++j) {
        for (int i = 0; i <= nx; ++i) {
            sheet.points.emplace_back(width * i / nx, height * j / ny);
        }
    }
    for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
            const Index a = j * (nx + 1) + i;
            const Index b = a + 1;
            const Index c = a + nx + 1;
            const Index d = c + 1;
            if (swap(i, j)) {
                sheet.triangles.push_back({a, b, c});
                sheet.triangles.push_back({b, d, c});
            } else {
                sheet.triangles.push_back({a, b, d});
                sheet.triangles.push_back({a, d, c});
            }
        }
    }
    return sheet;
}

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Angle at `at` between the directions to a and b.
double angle(const Vec2& at, const Vec2& a, const Vec2& b) {
    return std::atan2(std::abs(cross(a - at, b - at)), (a - at).dot(b - at));
}

/// Flips one inner edge whose opposite angles sum to more than pi; false when there is none.
bool flip_one(Sheet& sheet) {
    const auto point = [&](Index v) { return sheet.points[static_cast<std::size_t>(v)]; };
    for (const MeshEdge& edge : build_edges(sheet.triangles).edges) {
        if (edge.is_boundary()) {
            continue;
        }
        const auto [v0, v1] = edge.v;
        const auto [a, b] = edge.apex;
        const double sum =
            angle(point(a), point(v0), point(v1)) + angle(point(b), point(v0), point(v1));
        if (sum > M_PI + 1e-9) {
            sheet.triangles[static_cast<std::size_t>(edge.triangle[0])] = {a, v0, b};
            sheet.triangles[static_cast<std::size_t>(edge.triangle[1])] = {b, v1, a};
            return true;
        }
    }
    return false;
}

} // namespace

Sheet one_diagonal_sheet(int nx, int ny, double width, double height) {
    return grid(nx, ny, width, height, [](int, int) { return false; });
}

Sheet union_jack_sheet(int nx, int ny, double width, double height) {
    return grid(nx, ny, width, height, [](int i, int j) { return (i + j) % 2 == 1; });
}

Sheet equilateral_sheet(int nx, int ny, double side) {
    Sheet sheet = grid(nx, ny, nx, ny, [](int, int j) { return j % 2 == 0; });
    for (Vec2& p : sheet.points) {
        const bool odd = static_cast<int>(p.y()) % 2 == 1;
        p = side * Vec2(p.x() + (odd ? 0.5 : 0.0), p.y() * std::sqrt(0.75));
    }
    return sheet;
}

Sheet irregular_sheet(int nx, int ny, double width, double height, double jitter, unsigned seed) {
    Sheet sheet = one_diagonal_sheet(nx, ny, width, height);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-jitter, jitter);
    for (int j = 1; j < ny; ++j) {
        for (int i = 1; i < nx; ++i) {
            Vec2& p = sheet.points[static_cast<std::size_t>(j * (nx + 1) + i)];
            p += Vec2(uniform(random) * width / nx, uniform(random) * height / ny);
        }
    }
    while (flip_one(sheet)) {
    }
    return sheet;
}

const char* name_of(Pattern pattern) {
    return pattern == Pattern::OneDiagonal ? "one diagonal"
           : pattern == Pattern::UnionJack ? "union jack"
                                           : "irregular";
}

Sheet make_sheet(Pattern pattern, int nx, int ny, double width, double height) {
    constexpr double k_jitter = 0.25;
    constexpr unsigned k_seed = 3;
    return pattern == Pattern::OneDiagonal ? one_diagonal_sheet(nx, ny, width, height)
           : pattern == Pattern::UnionJack
               ? union_jack_sheet(nx, ny, width, height)
               : irregular_sheet(nx, ny, width, height, k_jitter, k_seed);
}

} // namespace weft
