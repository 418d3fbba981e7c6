#include "support/objects.h"

#include <map>

namespace weft::test {

namespace {

RestTriangle rest_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double length = (b - a).norm();
    const Vec3 along = (b - a) / length;
    Mat2 edges;
    edges << length, along.dot(c - a), 0.0, (c - a - along.dot(c - a) * along).norm();
    return {edges.inverse(), 0.5 * edges.determinant()};
}

Obstacle& add_obstacle(World& world, TriangleMesh mesh, const Vec3& origin) {
    Obstacle obstacle;
    obstacle.name = "obstacle" + std::to_string(world.obstacles.size());
    obstacle.mesh = std::move(mesh);
    obstacle.topology = build_edges(obstacle.mesh.triangles);
    obstacle.origin = origin;
    world.obstacles.push_back(std::move(obstacle));
    return world.obstacles.back();
}

TriangleMesh icosahedron() {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    TriangleMesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    return mesh;
}

TriangleMesh split_in_four(const TriangleMesh& mesh) {
    TriangleMesh fine{mesh.positions, {}};
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
        const auto [place, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                         static_cast<Index>(fine.positions.size()));
        if (is_new) {
            fine.positions.push_back(0.5 * (mesh.positions[static_cast<std::size_t>(a)] +
                                            mesh.positions[static_cast<std::size_t>(b)]));
        }
        return place->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const Index ab = middle(a, b);
        const Index bc = middle(b, c);
        const Index ca = middle(c, a);
        fine.triangles.insert(fine.triangles.end(),
                              {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

} // namespace

Cloth& add_sheet(World& world, int cells, double size, double height, const FabricParams& fabric) {
    Cloth cloth;
    cloth.name = "sheet" + std::to_string(world.cloths.size());
    cloth.params.fabric = fabric;
    cloth.first_vertex = static_cast<Index>(world.positions.size());
    const int n = cells + 1;
    cloth.vertex_count = n * n;
    const double cell = size / cells;
    std::vector<Vec3> positions;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            positions.emplace_back(i * cell - 0.5 * size, height, j * cell - 0.5 * size);
            cloth.material_positions.emplace_back(i * cell, j * cell);
        }
    }
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const Index a = j * n + i;
            const Index d = a + n;
            if ((i + j) % 2 == 0) {
                cloth.triangles.push_back({a, d, a + 1});
                cloth.triangles.push_back({a + 1, d, d + 1});
            } else {
                cloth.triangles.push_back({a, d, d + 1});
                cloth.triangles.push_back({a, d + 1, a + 1});
            }
        }
    }
    cloth.topology = build_edges(cloth.triangles);
    cloth.rest_areas.assign(positions.size(), 0.0);
    for (const Triangle& t : cloth.triangles) {
        const auto corner = [&](int k) {
            return positions[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
        };
        cloth.rest.push_back(rest_of(corner(0), corner(1), corner(2)));
        for (const Index v : t) {
            cloth.rest_areas[static_cast<std::size_t>(v)] += cloth.rest.back().area / 3.0;
        }
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
        world.positions.push_back(positions[i]);
        world.velocities.push_back(Vec3::Zero());
        world.masses.push_back(0.2 * cloth.rest_areas[i]);
    }
    extend_history(world);
    world.cloths.push_back(std::move(cloth));
    return world.cloths.back();
}

Obstacle& add_sphere(World& world, double radius, const Vec3& centre, int level) {
    TriangleMesh mesh = icosahedron();
    for (int i = 0; i < level; ++i) {
        mesh = split_in_four(mesh);
    }
    for (Vec3& x : mesh.positions) {
        x = radius * x.normalized();
    }
    return add_obstacle(world, std::move(mesh), centre);
}

Obstacle& add_floor(World& world, double size, double height) {
    const double r = 0.5 * size;
    TriangleMesh mesh;
    mesh.positions = {{-r, 0.0, -r}, {r, 0.0, -r}, {r, 0.0, r}, {-r, 0.0, r}};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    return add_obstacle(world, std::move(mesh), {0.0, height, 0.0});
}

Obstacle& add_box(World& world, const Vec3& size, const Vec3& centre) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back(
            0.5 * size.cwiseProduct(Vec3((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1)));
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return add_obstacle(world, std::move(mesh), centre);
}

} // namespace weft::test
