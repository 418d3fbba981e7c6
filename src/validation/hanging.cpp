#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <fmt/core.h>

#include <cmath>

namespace weft {

namespace {

constexpr double k_span = 1.0;      // m
constexpr double k_width = 0.02;    // m
constexpr double k_modulus = 1.0e5; // N/m: stretches by some 1e-5
constexpr int k_cells = 80;

struct Hanging {
    double sag;     ///< m
    double tension; ///< greatest, N
};

/// A limp strip of the given length hung by its short sides, k_span apart.
Hanging hang(double length) {
    const Sheet sheet = union_jack_sheet(k_cells, 2, length, k_width);
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(k_modulus, 0.0);
    const double slope = std::sqrt(length * length - k_span * k_span); // a V without strain
    World world = sheet_world(sheet, cloth, [&](const Vec2& p) {
        const double s = p.x() / length;
        return Vec3(k_span * s, -slope * std::min(s, 1.0 - s), p.y());
    });
    SceneParams scene = empty_space();
    scene.gravity = Vec3(0.0, -k_earth_gravity, 0.0);
    StaticLoad load(world.vertex_count());
    for (const Index v : vertices_where(
             sheet, [&](const Vec2& p) { return p.x() < 1e-9 || p.x() > length - 1e-9; })) {
        load.hold(v);
    }
    settle(world, scene, load, {.tolerance = 1e-8});

    const Eigen::VectorXd force = element_forces(world, scene);
    Hanging result{0.0, 0.0};
    Vec3 reaction = Vec3::Zero();
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        result.sag = std::max(result.sag, -world.positions[i].y());
        if (sheet.points[i].x() < 1e-9) {
            reaction -= force.segment<3>(static_cast<Eigen::Index>(3 * i));
            reaction -= world.masses[i] * scene.gravity;
        }
    }
    result.tension = reaction.norm();
    return result;
}

} // namespace

ValidationRows validate_catenary() {
    struct Theory {
        double length, sag, tension; ///< over span, and over rho g w span
    };
    const double weight = FabricParams{}.area_density * k_earth_gravity * k_width * k_span;
    ValidationRows rows;
    for (const Theory& theory : {Theory{1.05, 0.139304, 1.0589}, Theory{1.25, 0.331797, 0.75455},
                                 Theory{2.0, 0.796388, 1.02603}}) {
        const Hanging found = hang(theory.length * k_span);
        const std::string note = fmt::format("{} cells; limp; E = {:g} N/m", k_cells, k_modulus);
        rows.push_back({.what = fmt::format("sag / span at length {:g} span", theory.length),
                        .theory = theory.sag,
                        .measured = found.sag / k_span,
                        .tolerance = 0.002,
                        .note = note});
        rows.push_back({.what = fmt::format("greatest tension at length {:g} span", theory.length),
                        .unit = "weight/span",
                        .theory = theory.tension,
                        .measured = found.tension / weight,
                        .tolerance = 0.002,
                        .note = note});
    }
    return rows;
}

namespace {

constexpr double k_length = 1.0;          // m
constexpr double k_strip_width = 0.2;     // m
constexpr double k_strip_modulus = 100.0; // N/m: stretches by 0.7 %

/// Mean drop of the lower end below its rest position, m.
double tip_drop(const Sheet& sheet) {
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(k_strip_modulus, 0.0);
    World world = sheet_world(sheet, cloth);
    SceneParams scene = empty_space();
    scene.gravity = Vec3(0.0, -k_earth_gravity, 0.0);
    StaticLoad load(world.vertex_count());
    load.hold_all(2);
    for (const Index v :
         vertices_where(sheet, [](const Vec2& p) { return p.y() > k_length - 1e-9; })) {
        load.hold(v);
    }
    settle(world, scene, load, {.tolerance = 1e-11});
    const auto tip = vertices_where(sheet, [](const Vec2& p) { return p.y() < 1e-9; });
    double drop = 0.0;
    for (const Index v : tip) {
        drop -= world.positions[static_cast<std::size_t>(v)].y();
    }
    return drop / static_cast<double>(tip.size());
}

} // namespace

ValidationRows validate_hanging_strip() {
    const double theory = FabricParams{}.area_density * k_earth_gravity * k_length * k_length /
                          (2.0 * k_strip_modulus);
    ValidationRows rows;
    for (const int n : {5, 20}) {
        rows.push_back({.what = fmt::format("tip of a strip under its own weight: {} cells", n),
                        .unit = "m",
                        .theory = theory,
                        .measured = tip_drop(one_diagonal_sheet(2, n, k_strip_width, k_length)),
                        .tolerance = 1e-10,
                        .note = "rho g L^2 / (2 E); exact at the vertices of a regular mesh"});
    }
    return rows;
}

} // namespace weft
