#include "app/summary.h"

#include "frames/measures.h"

#include <fmt/core.h>

#include <numeric>

namespace weft {

namespace {

std::string size_text(std::span<const Vec3> positions) {
    Eigen::AlignedBox3d box;
    for (const Vec3& x : positions) {
        box.extend(x);
    }
    const Vec3 size = positions.empty() ? Vec3::Zero() : Vec3(box.sizes());
    return fmt::format("{:.3g} x {:.3g} x {:.3g} m", size.x(), size.y(), size.z());
}

std::size_t pins_of(const World& world, Index first, Index count) {
    return static_cast<std::size_t>(
        std::count_if(world.pins.begin(), world.pins.end(), [&](const Pin& pin) {
            return pin.vertex >= first && pin.vertex < first + count;
        }));
}

double mass_of(const World& world, Index first, Index count) {
    const auto begin = world.masses.begin() + first;
    return std::accumulate(begin, begin + count, 0.0);
}

std::string surface_text(const World& world, const Body& body) {
    const auto x = std::span(world.positions)
                       .subspan(static_cast<std::size_t>(body.first_vertex),
                                static_cast<std::size_t>(body.vertex_count));
    return fmt::format("{} triangles, {}", body.triangles.size(), size_text(x));
}

std::string describe(const World& world, const Solid& solid) {
    const Body& body = solid.body;
    return fmt::format("solid '{}': {} particles, {} cells, {} edges, {}, {:.4g} litres, {:.3g} "
                       "kg, {} pinned\n",
                       body.name, body.particle_count, solid.cells.size(), solid.network.size(),
                       surface_text(world, body), 1e3 * body_volume(world, body),
                       mass_of(world, body.first_particle, body.particle_count),
                       pins_of(world, body.first_particle, body.particle_count));
}

std::string describe(const World& world, const RigidBody& rigid) {
    const Body& body = rigid.body;
    return fmt::format("rigid '{}': {}, {:.3g} kg\n", body.name, surface_text(world, body),
                       mass_of(world, body.first_particle, body.particle_count));
}

} // namespace

std::string summarise(const Scene& scene, const World& world) {
    std::string text;
    for (const Cloth& cloth : world.cloths) {
        text += fmt::format(
            "cloth '{}': {} vertices, {} triangles, {}, {:.3g} kg, {}, {} pinned\n", cloth.name,
            cloth.vertex_count, cloth.triangles.size(), size_text(world.positions_of(cloth)),
            mass_of(world, cloth.first_vertex, cloth.vertex_count), cloth.params.fabric.name,
            pins_of(world, cloth.first_vertex, cloth.vertex_count));
    }
    for (const Solid& solid : world.solids) {
        text += describe(world, solid);
    }
    for (const RigidBody& rigid : world.rigids) {
        text += describe(world, rigid);
    }
    for (const Obstacle& obstacle : world.obstacles) {
        text += fmt::format("obstacle '{}': {} vertices, {} triangles, {}, {} key frames{}\n",
                            obstacle.name, obstacle.mesh.positions.size(),
                            obstacle.mesh.triangles.size(), size_text(obstacle.mesh.positions),
                            obstacle.params.motion.size(), deforms(obstacle) ? ", deforms" : "");
    }
    const SceneParams& s = scene.scene;
    const std::string substeps = s.substeps > 0 ? fmt::format("{}", s.substeps) : "automatic";
    const std::string pictures =
        scene.render.enabled
            ? fmt::format("{}x{} pictures", scene.render.size[0], scene.render.size[1])
            : "no pictures";
    double cache_bytes = 48.0 * static_cast<double>(world.vertex_count()) +
                         13.0 * static_cast<double>(world.triangle_count());
    for (const Obstacle& obstacle : world.obstacles) {
        if (deforms(obstacle)) {
            cache_bytes += 12.0 * static_cast<double>(obstacle.mesh.positions.size()) +
                           13.0 * static_cast<double>(obstacle.mesh.triangles.size());
        }
    }
    return text + fmt::format("run: {} frames at {} a second ({:.4g} s), {} substeps a frame, {}, "
                              "cache of about {:.3g} MB\n",
                              s.frames, s.fps, (s.frames - 1) / s.fps, substeps, pictures,
                              cache_bytes * s.frames / 1e6);
}

} // namespace weft
