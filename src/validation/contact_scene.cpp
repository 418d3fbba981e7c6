#include "validation/contact_scene.h"

#include "state/build_world.h"

#include <fmt/core.h>

#include <cassert>
#include <cmath>

namespace weft {

namespace {

constexpr std::array k_substeps{2, 4, 8};
constexpr std::array k_meshes{SheetMesh{Pattern::OneDiagonal, 4}, SheetMesh{Pattern::UnionJack, 6},
                              SheetMesh{Pattern::Irregular, 8}};

Vec3 mean(std::span<const Vec3> values) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& value : values) {
        sum += value;
    }
    return sum / static_cast<double>(values.size());
}

} // namespace

std::vector<Repeat> repeats(bool thorough) {
    std::vector<Repeat> all;
    for (std::size_t s = 0; s < k_substeps.size(); ++s) {
        for (std::size_t m = 0; m < k_meshes.size(); ++m) {
            if (thorough || s == m) {
                all.push_back({k_substeps[s], k_meshes[m]});
            }
        }
    }
    return all;
}

std::vector<Repeat> few_repeats(bool thorough) {
    return thorough ? repeats(true) : std::vector{Repeat{k_substeps[1], k_meshes[1]}};
}

std::string name_of(const Repeat& repeat) {
    return fmt::format("{} substeps; {} {} x {}", repeat.substeps, name_of(repeat.mesh.pattern),
                       repeat.mesh.cells, repeat.mesh.cells);
}

SceneParams contact_space(int substeps, double angle) {
    SceneParams params;
    params.fps = k_frame_rate;
    params.substeps = substeps;
    params.gravity = k_earth_gravity * Vec3(std::sin(angle), -std::cos(angle), 0.0);
    params.air_density = 0.0;
    return params;
}

std::function<Vec3(const Vec2&)> lying(const Vec2& size, const Vec3& middle) {
    return [=](const Vec2& p) {
        return Vec3(middle + Vec3(p.x() - size.x() / 2.0, 0.0, size.y() / 2.0 - p.y()));
    };
}

Obstacle& add_body(World& world, const std::string& name, TriangleMesh mesh, double friction) {
    ObstacleParams params{.name = name};
    params.friction = friction;
    return add_obstacle(world, params, {.mesh = std::move(mesh)});
}

void hold(World& world,
          const Cloth& cloth,
          std::vector<Index> vertices,
          const std::vector<std::array<double, 4>>& move) {
    const auto group = static_cast<Index>(world.pin_groups.size());
    world.pin_groups.push_back({move, k_forever});
    for (const Index v : vertices) {
        const Index vertex = cloth.first_vertex + v;
        world.pins.push_back({vertex, world.positions[at(vertex)], {}, group});
    }
    std::sort(world.pins.begin(), world.pins.end(),
              [](const Pin& a, const Pin& b) { return a.vertex < b.vertex; });
}

TriangleMesh cylinder_mesh(double radius, double length, int facets) {
    TriangleMesh mesh;
    for (int i = 0; i < facets; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / facets;
        const Vec3 out(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        mesh.positions.push_back(out - Vec3(0.0, 0.0, length / 2.0));
        mesh.positions.push_back(out + Vec3(0.0, 0.0, length / 2.0));
        const Index a = 2 * i;
        const Index b = 2 * ((i + 1) % facets);
        mesh.triangles.push_back({a, b, b + 1});
        mesh.triangles.push_back({a, b + 1, a + 1});
    }
    return mesh;
}

Vec3 mean_position(const World& world, const Cloth& cloth) {
    return mean(world.positions_of(cloth));
}

Vec3 mean_velocity(const World& world, const Cloth& cloth) {
    return mean(world.velocities_of(cloth));
}

} // namespace weft
