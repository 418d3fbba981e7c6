#include "geometry/shapes.h"
#include "validation/contact_scene.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <cmath>

/// A small sheet on an incline, and on another sheet that is held there: Coulomb's law for any
/// substep and mesh. Gravity is turned instead of the incline.
namespace weft {

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
constexpr double k_side = 0.2;       // m
constexpr double k_thickness = 1e-3; // m
constexpr int k_frames = 25;         // 1 s

enum class Ground { Plane, HeldSheet };

struct Incline {
    Ground ground;
    double angle; // rad
    double kinetic, at_rest;
    double push = 0.0; // speed down the incline at the start, m/s
};

/// Mean displacement and velocity down the incline after 1 s.
struct Slide {
    double distance, speed;
};

ClothParams cloth_of(const Incline& incline) {
    ClothParams params;
    params.fabric.area_density = 0.2;
    params.fabric.thickness = k_thickness;
    params.fabric.friction = incline.kinetic;
    params.fabric.static_friction = incline.at_rest;
    return params;
}

void add_ground(World& world, const Incline& incline) {
    if (incline.ground == Ground::Plane) {
        Obstacle& plane =
            add_body(world, "plane", plane_mesh(Vec3(20.0, 0.0, 20.0)), incline.kinetic);
        plane.params.static_friction = incline.at_rest;
        return;
    }
    const Vec2 size(3.0, 0.4);
    const Sheet sheet = make_sheet(Pattern::Irregular, 30, 4, size.x(), size.y());
    const Cloth& cloth =
        add_sheet(world, "held", sheet, cloth_of(incline), lying(size, Vec3(1.0, 0.0, 0.0)));
    hold(world, cloth, vertices_where(sheet, [](const Vec2&) { return true; }));
}

Slide slide_for_a_second(const Incline& incline, const Repeat& repeat) {
    World world;
    ClothParams params = cloth_of(incline);
    params.velocity.x() = incline.push;
    const auto [pattern, cells] = repeat.mesh;
    add_sheet(world, "sheet", make_sheet(pattern, cells, cells, k_side, k_side), params,
              lying(Vec2(k_side, k_side), Vec3(0.03, k_thickness, 0.02)));
    add_ground(world, incline);
    const Vec3 start = mean_position(world, world.cloths[0]);
    Stepper stepper({world, contact_space(repeat.substeps, incline.angle), {}});
    for (int frame = 0; frame < k_frames; ++frame) {
        stepper.advance_frame(world, {});
    }
    return {(mean_position(world, world.cloths[0]) - start).x(),
            mean_velocity(world, world.cloths[0]).x()};
}

double acceleration(const Incline& incline) {
    return k_earth_gravity * (std::sin(incline.angle) - incline.kinetic * std::cos(incline.angle));
}

/// What implicit Euler makes of a constant acceleration: h^2 n (n + 1) / 2 a.
double distance_of(const Incline& incline, const Repeat& repeat) {
    const double n = k_frames * repeat.substeps;
    return incline.push + acceleration(incline) * (n + 1.0) / (2.0 * n);
}

ValidationRow stick_row(std::string what, const Incline& incline, const Repeat& repeat) {
    return {.what = std::move(what),
            .unit = "m",
            .measured = slide_for_a_second(incline, repeat).distance,
            .tolerance = 1e-4,
            .relative = false,
            .note = name_of(repeat)};
}

ValidationRow
slide_row(std::string what, const Incline& incline, const Repeat& repeat, double tolerance) {
    return {.what = std::move(what),
            .unit = "m",
            .theory = distance_of(incline, repeat),
            .measured = slide_for_a_second(incline, repeat).distance,
            .tolerance = tolerance,
            .note = name_of(repeat)};
}

void add_rows(ValidationRows& rows, Ground ground, const Repeat& repeat) {
    constexpr double k_friction = 0.3;
    const double limit = std::atan(k_friction);
    const auto at_angle = [&](double angle) {
        return Incline{ground, angle, k_friction, k_friction};
    };
    rows.push_back(
        stick_row("creep in 1 s a degree below the limit", at_angle(limit - k_degree), repeat));
    rows.push_back(
        slide_row("slide in 1 s a degree above it", at_angle(limit + k_degree), repeat, 0.05));
    const Incline steep = at_angle(30.0 * k_degree);
    rows.push_back({.what = "acceleration at 30 degrees",
                    .unit = "m/s^2",
                    .theory = acceleration(steep),
                    .measured = slide_for_a_second(steep, repeat).speed,
                    .tolerance = 0.02,
                    .note = name_of(repeat)});
    Incline both{ground, 18.0 * k_degree, 0.25, 0.4}; // tan 18 deg = 0.325
    rows.push_back(stick_row("creep between the limits of 0.25 and 0.4", both, repeat));
    both.push = 0.3;
    rows.push_back(slide_row("slide there after a push", both, repeat, 0.02));
}

ValidationRows rows_on(Ground ground, bool thorough) {
    ValidationRows rows;
    for (const Repeat& repeat : repeats(thorough)) {
        add_rows(rows, ground, repeat);
    }
    return rows;
}

} // namespace

ValidationRows validate_incline(bool thorough) {
    return rows_on(Ground::Plane, thorough);
}

ValidationRows validate_two_sheets(bool thorough) {
    return rows_on(Ground::HeldSheet, thorough);
}

} // namespace weft
