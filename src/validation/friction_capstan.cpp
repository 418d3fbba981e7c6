#include "forces/membrane.h"
#include "validation/contact_scene.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <cmath>

/// A strip laid half around a cylinder and drawn over it slowly: Euler and Eytelwein's law, the
/// tensions of its two ends differ by exp(mu pi) when all of it slips.
namespace weft {

namespace {

constexpr double k_radius = 0.1;     // m
constexpr double k_thickness = 1e-3; // m
constexpr double k_tail = 0.1;       // m, straight, on either side
constexpr double k_width = 0.04;     // m
constexpr double k_stiffness = 1e3;  // N/m
constexpr double k_strain = 0.01;    // at the start
constexpr double k_friction = 0.3;
constexpr double k_speed = 5e-3; // m/s, of both ends: inertia does not count
constexpr int k_frames = 40;     // 8 mm: several times what the tensions need to part
constexpr int k_measured = 10;   // the last of them are measured

constexpr double k_bent_radius = k_radius + k_thickness;
constexpr double k_arc = std::numbers::pi * k_bent_radius;
constexpr double k_length = k_arc + 2.0 * k_tail;

/// Where the point at s (m, from the middle) along the strip and z across it lies.
Vec3 around(double s, double z) {
    const double turned = std::min(std::abs(s), k_arc / 2.0);
    const double tail = std::abs(s) - turned;
    const double angle = std::copysign(turned / k_bent_radius, s);
    return {k_bent_radius * std::sin(angle), k_bent_radius * std::cos(angle) - tail, z};
}

Sheet strip_sheet(const SheetMesh& mesh) {
    const int along = 8 * (mesh.cells + 2);
    const double rest_length = k_length / (1.0 + k_strain);
    const int across = static_cast<int>(std::lround(along * k_width / k_length));
    return make_sheet(mesh.pattern, along, across, rest_length, k_width);
}

/// Force along +y of the strip on some of its vertices, N.
double pull_on(const World& world, std::span<const Index> vertices) {
    const Cloth& cloth = world.cloths[0];
    const MembraneElements membrane(cloth);
    std::vector<Vec3> forces(3 * membrane.size());
    membrane.forces(world.positions_of(cloth), world.velocities_of(cloth), forces);
    double sum = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
        if (std::find(vertices.begin(), vertices.end(), membrane.nodes()[i]) != vertices.end()) {
            sum += forces[i].y();
        }
    }
    return sum;
}

double tension_ratio(const Repeat& repeat) {
    ClothParams params;
    params.fabric = isotropic_membrane(k_stiffness, 0.0);
    params.fabric.area_density = 0.2;
    params.fabric.bend_stiffness = 1e-6;
    params.fabric.thickness = k_thickness;
    params.fabric.friction = k_friction;
    const Sheet sheet = strip_sheet(repeat.mesh);
    World world;
    const Cloth& cloth = add_sheet(world, "strip", sheet, params, [](const Vec2& p) {
        return around((1.0 + k_strain) * p.x() - k_length / 2.0, p.y() - k_width / 2.0);
    });
    add_body(world, "cylinder", cylinder_mesh(k_radius, 2.0 * k_width, 256), k_friction);
    const auto end = [&](double x) {
        return vertices_where(sheet, [=](const Vec2& p) { return std::abs(p.x() - x) < 1e-9; });
    };
    const std::vector<Index> slack = end(0.0);
    const std::vector<Index> tight = end(k_length / (1.0 + k_strain));
    constexpr double k_end = k_frames / k_frame_rate;
    hold(world, cloth, slack, {{0.0, 0.0, 0.0, 0.0}, {k_end, 0.0, k_speed * k_end, 0.0}});
    hold(world, cloth, tight, {{0.0, 0.0, 0.0, 0.0}, {k_end, 0.0, -k_speed * k_end, 0.0}});

    SceneParams space = contact_space(repeat.substeps);
    space.gravity.setZero();
    Stepper stepper({world, space, {}});
    double sum = 0.0;
    for (int frame = 1; frame <= k_frames; ++frame) {
        stepper.advance_frame(world, {});
        if (frame > k_frames - k_measured) {
            sum += pull_on(world, tight) / pull_on(world, slack);
        }
    }
    return sum / k_measured;
}

} // namespace

ValidationRows validate_capstan(bool thorough) {
    ValidationRows rows;
    for (const Repeat& repeat : repeats(thorough)) {
        const SheetMesh mesh{repeat.mesh.pattern, 8 * (repeat.mesh.cells + 2)};
        rows.push_back({.what = "tension ratio over half a turn",
                        .theory = std::exp(k_friction * std::numbers::pi),
                        .measured = tension_ratio(repeat),
                        .tolerance = 0.03,
                        .note = fmt::format("{} substeps; {}; {} cells along", repeat.substeps,
                                            name_of(mesh.pattern), mesh.cells)});
    }
    return rows;
}

} // namespace weft
