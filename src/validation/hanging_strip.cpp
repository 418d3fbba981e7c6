#include <fmt/core.h>

#include "validation/experiments.h"
#include "validation/sheet_world.h"
#include "validation/statics.h"

namespace weft {

namespace {

constexpr double k_length = 1.0;    // m
constexpr double k_width = 0.2;     // m
constexpr double k_modulus = 100.0; // N/m: stretches by 0.7 %
constexpr double k_gravity = 9.81;  // m/s^2

/// Mean drop of the lower end below its rest position, m.
double tip_drop(const Sheet& sheet) {
    ClothParams cloth;
    cloth.fabric = isotropic_fabric(k_modulus, 0.0);
    World world = sheet_world(sheet, cloth);
    SceneParams scene = empty_space();
    scene.gravity = Vec3(0.0, -k_gravity, 0.0);
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
    const double theory =
        FabricParams{}.area_density * k_gravity * k_length * k_length / (2.0 * k_modulus);
    ValidationRows rows;
    for (const int n : {5, 20}) {
        rows.push_back({.what = fmt::format("tip of a strip under its own weight: {} cells", n),
                        .unit = "m",
                        .theory = theory,
                        .measured = tip_drop(one_diagonal_sheet(2, n, k_width, k_length)),
                        .tolerance = 1e-10,
                        .note = "rho g L^2 / (2 E); exact at the vertices of a regular mesh"});
    }
    return rows;
}

} // namespace weft
