#include "geometry/shapes.h"
#include "scene/pose.h"
#include "validation/contact_scene.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

/// Ten sheets let fall on a floor from a small height, each turned against the next.
namespace weft {

namespace {

constexpr int k_sheets = 10;
constexpr double k_side = 0.2;                   // m
constexpr double k_thickness = 2e-3;             // m
constexpr double k_start_gap = 1.3;              // gap at the start over the thickness
constexpr double k_turn_deg = 9.0;               // angle of each sheet to the one below
constexpr double k_inner = 0.08;                 // m from the axis: inside all of the squares
constexpr double k_calm_from = 3.0, k_end = 5.0; // s

World stacked_sheets(const SheetMesh& mesh) {
    World world;
    ClothParams params;
    params.fabric.area_density = 0.2;
    params.fabric.thickness = k_thickness;
    params.fabric.damping = {0.0, 1e-3};
    const Sheet sheet = make_sheet(mesh.pattern, mesh.cells, mesh.cells, k_side, k_side);
    const auto flat = lying(Vec2(k_side, k_side), Vec3::Zero());
    for (int k = 0; k < k_sheets; ++k) {
        const Mat3 turn = rotation_from_degrees(Vec3(0.0, k_turn_deg * k, 0.0));
        const Vec3 up(0.0, k_start_gap * k_thickness * (k + 1), 0.0);
        add_sheet(world, fmt::format("sheet{}", k), sheet, params,
                  [&](const Vec2& p) { return Vec3(turn * flat(p) + up); });
    }
    add_body(world, "floor", plane_mesh(Vec3(2.0, 0.0, 2.0)), 0.3);
    return world;
}

/// Height of a cloth above or below (x, z), of a triangle that it has there.
std::optional<double> height_at(const World& world, const Cloth& cloth, const Vec3& place) {
    const auto x = world.positions_of(cloth);
    for (const Triangle& t : cloth.triangles) {
        const Vec3 &a = x[at(t[0])], &b = x[at(t[1])], &c = x[at(t[2])];
        Mat2 edges;
        edges << b.x() - a.x(), c.x() - a.x(), b.z() - a.z(), c.z() - a.z();
        const Vec2 w = edges.inverse() * Vec2(place.x() - a.x(), place.z() - a.z());
        if (w.x() >= 0.0 && w.y() >= 0.0 && w.sum() <= 1.0) {
            return a.y() + w.x() * (b.y() - a.y()) + w.y() * (c.y() - a.y());
        }
    }
    return std::nullopt;
}

struct Gaps {
    double least = 1e9, greatest = 0.0;
};

/// Between each sheet's vertices and what lies below them, m.
Gaps gaps_of(const World& world) {
    Gaps gaps;
    for (std::size_t k = 0; k < world.cloths.size(); ++k) {
        for (const Vec3& x : world.positions_of(world.cloths[k])) {
            if (std::hypot(x.x(), x.z()) > k_inner) {
                continue;
            }
            const double below =
                k == 0 ? 0.0 : height_at(world, world.cloths[k - 1], x).value_or(std::nan(""));
            gaps.least = std::min(gaps.least, x.y() - below);
            gaps.greatest = std::max(gaps.greatest, x.y() - below);
        }
    }
    return gaps;
}

ValidationRow gap_row(std::string what, double gap, const Repeat& repeat) {
    return {.what = std::move(what),
            .unit = "m",
            .theory = k_thickness,
            .measured = gap,
            .tolerance = 0.1,
            .note = name_of(repeat)};
}

void add_rows(ValidationRows& rows, const Repeat& repeat) {
    World world = stacked_sheets(repeat.mesh);
    Stepper stepper({world, contact_space(repeat.substeps), {}});
    double restless = 0.0; // the last time with more than 1e-6 J
    double greatest = 0.0;
    while (world.time < k_end - 1e-9) {
        stepper.advance_frame(world, {});
        const double energy = kinetic_energy(world);
        restless = energy > 1e-6 ? world.time : restless;
        greatest = world.time > k_calm_from ? std::max(greatest, energy) : 0.0;
    }
    rows.push_back(
        {.what = "greatest kinetic energy from 3 s to 5 s",
         .unit = "J",
         .measured = greatest,
         .tolerance = 1e-6,
         .relative = false,
         .note = fmt::format("{}; above 1e-6 J until {:.2f} s", name_of(repeat), restless)});
    const Gaps gaps = gaps_of(world);
    rows.push_back(gap_row("least gap between neighbours", gaps.least, repeat));
    rows.push_back(gap_row("greatest gap between neighbours", gaps.greatest, repeat));
}

} // namespace

ValidationRows validate_stack(bool thorough) {
    ValidationRows rows;
    for (const Repeat& repeat : few_repeats(thorough)) {
        add_rows(rows, repeat);
    }
    return rows;
}

} // namespace weft
