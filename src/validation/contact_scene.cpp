#include "validation/contact_scene.h"

#include <fmt/core.h>

#include <cassert>
#include <cmath>

namespace weft {

namespace {

constexpr std::array k_substeps{2, 4, 8};
constexpr std::array k_meshes{SheetMesh{Pattern::OneDiagonal, 4}, SheetMesh{Pattern::UnionJack, 6},
                              SheetMesh{Pattern::Irregular, 8}};

template <typename T> void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

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
    params.gravity = k_gravity * Vec3(std::sin(angle), -std::cos(angle), 0.0);
    params.air_density = 0.0;
    return params;
}

Cloth& add_cloth(World& world,
                 const std::string& name,
                 const Sheet& sheet,
                 const ClothParams& params,
                 const std::function<Vec3(const Vec2&)>& place) {
    World one = sheet_world(sheet, params, place);
    Cloth& cloth = one.cloths.front();
    cloth.name = name;
    cloth.first_vertex = static_cast<Index>(world.vertex_count());
    append(world.positions, one.positions);
    append(world.velocities, one.velocities);
    append(world.masses, one.masses);
    append(world.previous_positions, one.previous_positions);
    append(world.previous_velocities, one.previous_velocities);
    return world.cloths.emplace_back(std::move(cloth));
}

std::function<Vec3(const Vec2&)> lying(const Vec2& size, const Vec3& middle) {
    return [=](const Vec2& p) {
        return Vec3(middle + Vec3(p.x() - size.x() / 2.0, 0.0, size.y() / 2.0 - p.y()));
    };
}

Obstacle& add_body(World& world, const std::string& name, TriangleMesh mesh, double friction) {
    Obstacle obstacle;
    obstacle.name = name;
    obstacle.params.name = name;
    obstacle.params.friction = friction;
    obstacle.mesh = std::move(mesh);
    obstacle.topology = build_edges(obstacle.mesh.triangles);
    return world.obstacles.emplace_back(std::move(obstacle));
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
