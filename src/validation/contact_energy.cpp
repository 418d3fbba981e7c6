#include "geometry/shapes.h"
#include "scene/pose.h"

#include <fmt/core.h>

#include <array>

#include "validation/contact_scene.h"
#include "validation/experiments.h"
#include "validation/motion.h"

/// Energy of cloth that touches resting bodies and itself: kinetic, elastic and of height, looked
/// at after every substep. Nothing does work on it, so that it can only fall, but for what contact
/// stores between two substeps. With one linearisation a substep the membrane itself can gain from
/// a sudden turn; solved to convergence, a gain is contact's.
namespace weft {

namespace {

constexpr double k_thickness = 1e-3; // m
constexpr double k_seconds = 1.0;

ClothParams cloth_params() {
    ClothParams params;
    params.fabric = isotropic_fabric(500.0, 0.25, 1e-5);
    params.fabric.thickness = k_thickness;
    return params;
}

void add_square(World& world, const SheetMesh& mesh, double side, const Vec3& turn_deg, double y) {
    const int n = 2 * mesh.cells;
    const auto flat = lying(Vec2(side, side), Vec3::Zero());
    const Mat3 turn = rotation_from_degrees(turn_deg);
    add_cloth(world, fmt::format("sheet{}", world.cloths.size()),
              make_sheet(mesh.pattern, n, n, side, side), cloth_params(),
              [&](const Vec2& p) { return Vec3(turn * flat(p) + y * Vec3::UnitY()); });
}

World sheet_over_sphere(const SheetMesh& mesh) {
    World world;
    add_square(world, mesh, 0.3, Vec3(3.0, 10.0, 2.0), 0.15);
    add_body(world, "sphere", sphere_mesh(0.1), 0.3);
    return world;
}

World three_on_the_floor(const SheetMesh& mesh) {
    World world;
    for (int k = 0; k < 3; ++k) {
        add_square(world, mesh, 0.2, Vec3(2.0 * k, 15.0 * k, 1.0), 0.02 * (k + 1));
    }
    add_body(world, "floor", plane_mesh(Vec3(2.0, 0.0, 2.0)), 0.3);
    return world;
}

World meeting_sheets(const SheetMesh& mesh) {
    World world;
    add_square(world, mesh, 0.3, Vec3::Zero(), -0.02);
    add_square(world, mesh, 0.2, Vec3(4.0, 20.0, 3.0), 0.02);
    const Cloth& upper = world.cloths[1];
    for (Index v = upper.first_vertex; v < upper.first_vertex + upper.vertex_count; ++v) {
        world.velocities[static_cast<std::size_t>(v)] = Vec3(0.2, -1.0, 0.0);
    }
    return world;
}

double energy(const World& world, const Vec3& gravity) {
    double sum = free_energy(world);
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum -= world.masses[i] * gravity.dot(world.positions[i]);
    }
    return sum;
}

/// The greatest rise of the energy above the least so far, as a share of what is lost in all.
double greatest_return(World world, int substeps, int newton, const Vec3& gravity) {
    SceneParams space = contact_space(1);
    space.fps = k_frame_rate * substeps; // a frame is a substep
    space.gravity = gravity;
    space.newton = newton;
    Stepper stepper({world, space, {}});
    const double start = energy(world, gravity);
    double least = start;
    double greatest = 0.0;
    while (world.time < k_seconds - 1e-9) {
        stepper.advance_frame(world, {});
        const double now = energy(world, gravity);
        greatest = std::max(greatest, now - least);
        least = std::min(least, now);
    }
    return greatest / (start - least);
}

struct Case {
    const char* name;
    World (*build)(const SheetMesh&);
    double gravity; // m/s^2
};
constexpr std::array k_cases{
    Case{"sheet falls on a sphere", sheet_over_sphere, k_gravity},
    Case{"three sheets fall on a floor", three_on_the_floor, k_gravity},
    Case{"two sheets meet in empty space", meeting_sheets, 0.0},
};

ValidationRow row(const Case& one, const Repeat& repeat, int newton) {
    const auto& [pattern, cells] = repeat.mesh;
    return {.what = fmt::format("energy that came back: {}", one.name),
            .measured = greatest_return(one.build(repeat.mesh), repeat.substeps, newton,
                                        Vec3(0.0, -one.gravity, 0.0)),
            .tolerance = 1e-3,
            .relative = false,
            .note = fmt::format("newton {}; {} substeps; {} {} x {}", newton, repeat.substeps,
                                name_of(pattern), 2 * cells, 2 * cells)};
}

} // namespace

ValidationRows validate_contact_energy(bool thorough) {
    ValidationRows rows;
    for (const int newton : {10, 1}) {
        for (const Repeat& repeat : few_repeats(thorough)) {
            for (const Case& one : k_cases) {
                rows.push_back(row(one, repeat, newton));
            }
        }
    }
    return rows;
}

} // namespace weft
