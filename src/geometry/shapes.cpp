#include "geometry/shapes.h"

#include <cmath>
#include <map>
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

namespace {

constexpr int k_sphere_splits = 4; // chord error r (1 - cos(pi/5/2^4/2)) is 0.05 % of the radius

TriangleMesh icosahedron() {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    TriangleMesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return mesh;
}

/// Splits each triangle into four at its edges' midpoints.
TriangleMesh split_in_four(const TriangleMesh& coarse) {
    TriangleMesh fine;
    fine.positions = coarse.positions;
    std::map<std::pair<Index, Index>, Index> middle;
    const auto middle_of = [&](Index a, Index b) {
        const auto [entry, is_new] =
            middle.try_emplace(std::minmax(a, b), static_cast<Index>(fine.positions.size()));
        if (is_new) {
            fine.positions.push_back(0.5 * (coarse.positions[static_cast<std::size_t>(a)] +
                                            coarse.positions[static_cast<std::size_t>(b)]));
        }
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const Index ab = middle_of(a, b);
        const Index bc = middle_of(b, c);
        const Index ca = middle_of(c, a);
        fine.triangles.insert(fine.triangles.end(),
                              {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

} // namespace

TriangleMesh sphere_mesh(double radius) {
    TriangleMesh mesh = icosahedron();
    for (int i = 0; i < k_sphere_splits; ++i) {
        for (Vec3& x : mesh.positions) {
            x.normalize();
        }
        mesh = split_in_four(mesh);
    }
    for (Vec3& x : mesh.positions) {
        x = x.normalized() * radius;
    }
    return mesh;
}

TriangleMesh box_mesh(const Vec3& size) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner((i & 1) != 0 ? 0.5 : -0.5, (i & 2) != 0 ? 0.5 : -0.5,
                          (i & 4) != 0 ? 0.5 : -0.5);
        mesh.positions.push_back(corner.cwiseProduct(size));
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh plane_mesh(const Vec3& size) {
    return grid_mesh(Vec2(size.x(), size.z()), {1, 1});
}

TriangleMesh grid_mesh(const Vec2& size, const std::array<int, 2>& cells) {
    TriangleMesh mesh;
    const int row = cells[0] + 1;
    for (int j = 0; j <= cells[1]; ++j) {
        for (int i = 0; i < row; ++i) {
            mesh.positions.emplace_back(size.x() * (static_cast<double>(i) / cells[0] - 0.5), 0.0,
                                        size.y() * (static_cast<double>(j) / cells[1] - 0.5));
        }
    }
    for (int j = 0; j < cells[1]; ++j) {
        for (int i = 0; i < cells[0]; ++i) {
            const Index a = j * row + i; // a b
            const Index b = a + 1;       // c d, z growing downwards
            const Index c = a + row;
            const Index d = c + 1;
            if ((i + j) % 2 == 0) {
                mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
            } else {
                mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
            }
        }
    }
    return mesh;
}

} // namespace weft
