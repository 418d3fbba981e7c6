#include "geometry/shapes.h"
#include "validation/contact_scene.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <cmath>

/// Bodies that carry cloth along by friction alone.
namespace weft {

namespace {

constexpr double k_thickness = 1e-3; // m
constexpr double k_belt_speed = 0.5; // m/s
constexpr double k_belt_friction = 0.3;
constexpr double k_belt_sheet = 0.2; // m
constexpr double k_radius = 0.1;     // m, of the sphere
constexpr double k_turn = 1.0;       // rad/s
constexpr double k_cloth = 0.16;     // m, side, over the sphere
constexpr double k_cap = 0.05;       // m from the axis: what surely lies on the sphere

ClothParams carried_cloth(double friction) {
    ClothParams params;
    params.fabric.area_density = 0.2;
    params.fabric.thickness = k_thickness;
    params.fabric.friction = friction;
    params.fabric.damping = {0.0, 1e-3};
    return params;
}

void run(Stepper& stepper, World& world, double seconds) {
    const int frames = static_cast<int>(std::lround(seconds * k_frame_rate));
    for (int i = 0; i < frames; ++i) {
        stepper.advance_frame(world, {});
    }
}

/// How far implicit Euler lets a sheet fall behind a belt that pulls it up to speed.
double lag_of(int substeps) {
    const double h = 1.0 / (k_frame_rate * substeps);
    double lag = 0.0;
    for (double speed = 0.0; speed < k_belt_speed;) {
        speed = std::min(k_belt_speed, speed + h * k_belt_friction * k_earth_gravity);
        lag += h * (k_belt_speed - speed);
    }
    return lag;
}

/// A sheet laid at rest on a belt that runs.
void add_belt_rows(ValidationRows& rows, const Repeat& repeat) {
    World world;
    const auto [pattern, cells] = repeat.mesh;
    const Vec2 size(k_belt_sheet, k_belt_sheet);
    const Cloth& cloth =
        add_sheet(world, "sheet", make_sheet(pattern, cells, cells, size.x(), size.y()),
                  carried_cloth(k_belt_friction), lying(size, Vec3(0.03, k_thickness, 0.02)));
    Obstacle& belt = add_body(world, "belt", plane_mesh(Vec3(20.0, 0.0, 20.0)), k_belt_friction);
    belt.params.motion = {{}, {.t = 10.0, .translate = 10.0 * k_belt_speed * Vec3::UnitX()}};
    const double start = mean_position(world, cloth).x();
    Stepper stepper({world, contact_space(repeat.substeps), {}});
    const auto lag = [&] {
        return start + k_belt_speed * world.time - mean_position(world, cloth).x();
    };
    run(stepper, world, 1.0);
    const double first = lag();
    run(stepper, world, 1.0);
    rows.push_back({.what = "slip on a conveyor until it has taken the sheet along",
                    .unit = "m",
                    .theory = lag_of(repeat.substeps),
                    .measured = first,
                    .tolerance = 0.02,
                    .note = name_of(repeat)});
    rows.push_back({.what = "creep in the second after that",
                    .unit = "m",
                    .measured = lag() - first,
                    .tolerance = 1e-4,
                    .relative = false,
                    .note = name_of(repeat)});
    rows.push_back({.what = "speed on the conveyor",
                    .unit = "m/s",
                    .theory = k_belt_speed,
                    .measured = mean_velocity(world, cloth).x(),
                    .tolerance = 1e-3,
                    .note = name_of(repeat)});
}

/// Greatest creep (m) of the cloth on top of the sphere against it, while the sphere turned by
/// `angle` about the y axis.
double creep_on_top(std::span<const Vec3> before, std::span<const Vec3> after, double angle) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
    double greatest = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (std::hypot(before[i].x(), before[i].z()) < k_cap && before[i].y() > 0.0) {
            greatest = std::max(greatest, (after[i] - turn * before[i]).norm());
        }
    }
    return greatest;
}

/// A cloth laid over a sphere that begins to turn about the vertical axis after 1 s.
void add_sphere_rows(ValidationRows& rows, const Repeat& repeat) {
    World world;
    const auto [pattern, mesh_cells] = repeat.mesh;
    const int cells = 2 * mesh_cells;
    const Vec2 size(k_cloth, k_cloth);
    const Cloth& cloth =
        add_sheet(world, "cloth", make_sheet(pattern, cells, cells, size.x(), size.y()),
                  carried_cloth(0.5), lying(size, Vec3(0.0, k_radius + k_thickness, 0.0)));
    Obstacle& sphere = add_body(world, "sphere", sphere_mesh(k_radius), 0.5);
    const double degrees = 2.0 * k_turn * 180.0 / std::numbers::pi;
    sphere.params.motion = {{.t = 1.0}, {.t = 3.0, .rotate_deg = degrees * Vec3::UnitY()}};
    Stepper stepper({world, contact_space(repeat.substeps), {}});
    run(stepper, world, 2.0);
    const std::vector<Vec3> before = world.positions;
    run(stepper, world, 1.0);
    const double height = mean_position(world, cloth).y();
    rows.push_back(
        {.what = "creep in 1 s of a cloth against the sphere that turns below it",
         .unit = "m",
         .measured = height > 0.0 ? creep_on_top(before, world.positions, k_turn) : std::nan(""),
         .tolerance = 1e-4,
         .relative = false,
         .note = fmt::format("{} substeps; {} {} x {}", repeat.substeps, name_of(pattern), cells,
                             cells)});
}

} // namespace

ValidationRows validate_drag(bool thorough) {
    ValidationRows rows;
    for (const Repeat& repeat : repeats(thorough)) {
        add_belt_rows(rows, repeat);
    }
    for (const Repeat& repeat : few_repeats(thorough)) {
        add_sphere_rows(rows, repeat);
    }
    return rows;
}

} // namespace weft
