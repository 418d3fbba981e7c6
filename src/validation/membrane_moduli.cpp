#include "validation/experiment_world.h"
#include "validation/experiments.h"
#include "validation/statics.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace weft {

namespace {

/// The orthotropic fabric of the off-axis table.
FabricParams woven() {
    FabricParams fabric;
    fabric.stretch_stiffness = Vec2(1500.0, 600.0);
    fabric.shear_stiffness = 90.0;
    fabric.poisson = 0.25 * std::sqrt(600.0 / 1500.0); // sqrt(nu12 nu21) of nu12 = 0.25
    fabric.bend_stiffness = 0.0;
    return fabric;
}

bool on_rim(const Vec2& p) {
    return p.x() <= 0.0 || p.x() >= 1.0 || p.y() <= 0.0 || p.y() >= 1.0;
}

/// 20 % along the weft, 10 % across, 15 % shear, in a plane that is turned in space.
Vec3 stretched(const Vec2& p) {
    const Vec3 in_plane(1.2 * p.x() + 0.1 * p.y(), 0.05 * p.x() + 1.1 * p.y(), 0.0);
    return Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()) * in_plane;
}

} // namespace

ValidationRows validate_patch_test() {
    const Sheet sheet = irregular_sheet(8, 8, 1.0, 1.0, 0.3, 5);
    ClothParams cloth;
    cloth.fabric = woven();
    World world = sheet_world(sheet, cloth, stretched);
    const std::vector<Vec3> affine = world.positions;
    const Eigen::VectorXd force = element_forces(world, empty_space());

    StaticLoad load(world.vertex_count());
    double on_inner = 0.0;
    double greatest = 0.0;
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        const double size = force.segment<3>(static_cast<Eigen::Index>(3 * i)).norm();
        greatest = std::max(greatest, size);
        if (on_rim(sheet.points[i])) {
            load.hold(static_cast<Index>(i));
        } else {
            on_inner = std::max(on_inner, size);
            world.positions[i] += Vec3(0.02, -0.01, 0.015); // to be taken back by settling
        }
    }
    settle(world, empty_space(), load, {.tolerance = 1e-13});
    double off = 0.0;
    for (std::size_t i = 0; i < affine.size(); ++i) {
        off = std::max(off, (world.positions[i] - affine[i]).norm());
    }
    return {{.what = "force on inner vertices / on the rim",
             .theory = 0.0,
             .measured = on_inner / greatest,
             .tolerance = 1e-12,
             .relative = false,
             .note = "irregular mesh; orthotropic; 20 % strain"},
            {.what = "inner vertices after settling",
             .unit = "m",
             .theory = 0.0,
             .measured = off,
             .tolerance = 1e-12,
             .relative = false,
             .note = "from a start 2.7 cm away; distance to the affine field"}};
}

ValidationRows validate_uniaxial() {
    constexpr double k_modulus = 1000.0;
    constexpr double k_poisson = 0.3;
    ClothParams cloth;
    cloth.fabric = isotropic_membrane(k_modulus, k_poisson);
    ValidationRows rows;
    for (const Pattern pattern : k_patterns) {
        const Sheet sheet = make_sheet(pattern, 8, 8, 1.0, 1.0);
        const char* name = name_of(pattern);
        const World world = sheet_world(sheet, cloth);
        const Elasticity found = tensile_test(sheet, stiffness_matrix(world, empty_space()));
        rows.push_back({.what = fmt::format("Young's modulus: {}", name),
                        .unit = "N/m",
                        .theory = k_modulus,
                        .measured = found.modulus,
                        .tolerance = 1e-12,
                        .note = "8 x 8 cells"});
        rows.push_back({.what = fmt::format("Poisson ratio: {}", name),
                        .theory = k_poisson,
                        .measured = found.poisson,
                        .tolerance = 1e-12,
                        .note = "8 x 8 cells"});
    }
    return rows;
}

namespace {

constexpr double k_e1 = 1500.0, k_e2 = 600.0, k_nu12 = 0.25, k_shear = 90.0; // N/m, 1

/// 1/E(t) of a sheet pulled at angle t from direction 1, free to narrow and to shear.
double modulus_at(double angle) {
    const double c2 = std::cos(angle) * std::cos(angle);
    const double s2 = 1.0 - c2;
    return 1.0 /
           (c2 * c2 / k_e1 + s2 * s2 / k_e2 + (1.0 / k_shear - 2.0 * k_nu12 / k_e1) * c2 * s2);
}

/// Pulls a unit square along x by a uniform tension of 1 N/m on its ends; 1 / mean strain.
double measured_modulus(const Sheet& sheet, int cells, double grain_deg) {
    ClothParams cloth;
    cloth.fabric.stretch_stiffness = Vec2(k_e1, k_e2);
    cloth.fabric.shear_stiffness = k_shear;
    cloth.fabric.poisson = k_nu12 * std::sqrt(k_e2 / k_e1);
    cloth.fabric.bend_stiffness = 0.0;
    cloth.grain_deg = grain_deg;
    const World world = sheet_world(sheet, cloth);

    StaticLoad load(world.vertex_count());
    load.hold_all(2);
    load.hold(0, 0);
    load.hold(0, 1);
    load.hold(static_cast<Index>(cells), 1); // the corner along x: no turning
    double extension = 0.0;
    const auto end = [&](double at) {
        return vertices_where(sheet, [=](const Vec2& p) { return std::abs(p.x() - at) < 1e-9; });
    };
    for (const double at : {0.0, 1.0}) {
        for (const Index v : end(at)) {
            const double y = sheet.points[static_cast<std::size_t>(v)].y();
            const bool is_corner = y < 1e-9 || y > 1.0 - 1e-9;
            load.add(v, Vec3((at > 0.5 ? 1.0 : -1.0) * (is_corner ? 0.5 : 1.0) / cells, 0.0, 0.0));
        }
    }
    const Eigen::VectorXd u = linear_response(stiffness_matrix(world, empty_space()), load);
    for (const Index v : end(1.0)) {
        extension += u[3 * v] / (cells + 1);
    }
    for (const Index v : end(0.0)) {
        extension -= u[3 * v] / (cells + 1);
    }
    return 1.0 / extension;
}

} // namespace

ValidationRows validate_off_axis() {
    constexpr int k_cells = 8;
    const Sheet sheet = irregular_sheet(k_cells, k_cells, 1.0, 1.0, 0.3, 7);
    ValidationRows rows;
    for (const int degrees : {0, 15, 30, 45, 60, 75, 90}) {
        rows.push_back({.what = fmt::format("modulus at {} degrees from the weft", degrees),
                        .unit = "N/m",
                        .theory = modulus_at(degrees * std::numbers::pi / 180.0),
                        .measured = measured_modulus(sheet, k_cells, degrees),
                        .tolerance = 1e-10,
                        .note = "irregular mesh; E 1500 and 600 N/m; G 90 N/m; nu12 0.25"});
    }
    return rows;
}

} // namespace weft
