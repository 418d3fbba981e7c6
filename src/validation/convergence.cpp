#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {

/// The order of an integrator: a soft strip that hangs stretched by its weight is pushed out of its
/// plane and swings; its shape after 0.4 s with h, h/2 and h/4 gives
/// log2(|x_h - x_h/2| / |x_h/2 - x_h/4|).
namespace {

constexpr double k_length = 1.0;   ///< m
constexpr double k_stretch = 20.0; ///< N/m: slow enough for its vibrations to be resolved
constexpr double k_time = 0.4;     ///< s
constexpr int k_cells = 8;

std::vector<Vec3> swung(Integrator integrator, int substeps) {
    Scene scene =
        vacuum_scene({0.25, k_length}, {2, k_cells}, isotropic_fabric(k_stretch, 0.0, 1e-4));
    scene.scene.gravity = Vec3(0.0, 0.0, k_earth_gravity);
    scene.scene.integrator = integrator;
    scene.scene.newton = 100;
    scene.cloths[0].pins.push_back({.vertices = {0, 1, 2}});
    FreeMotion motion(scene);
    World& world = motion.world;
    const double sag = scene.cloths[0].fabric.area_density * k_earth_gravity / k_stretch;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        const double s = world.positions[i].z() + 0.5 * k_length; // from the top, at rest
        world.positions[i].z() += sag * (k_length * s - 0.5 * s * s);
        world.velocities[i].y() = 0.5 * s * s / k_length; // no kink at the top
    }
    motion.steps(k_time / substeps, substeps);
    return world.positions;
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += (a[i] - b[i]).squaredNorm();
    }
    return std::sqrt(sum);
}

ValidationRow order_row(Integrator integrator, int substeps) {
    const auto coarse = swung(integrator, substeps);
    const auto middle = swung(integrator, 2 * substeps);
    const auto fine = swung(integrator, 4 * substeps);
    const bool euler = integrator == Integrator::Euler;
    return {.what = fmt::format("order in time: {}", euler ? "implicit Euler" : "BDF2"),
            .theory = euler ? 1.0 : 2.0,
            .measured = std::log2(distance(coarse, middle) / distance(middle, fine)),
            .tolerance = 0.15,
            .relative = false,
            .note = fmt::format("free swing; 0.4 s in {}; {} and {} substeps", substeps,
                                2 * substeps, 4 * substeps)};
}

} // namespace

ValidationRows validate_order_in_time() {
    return {order_row(Integrator::Euler, 160), order_row(Integrator::Bdf2, 160)};
}

/// The order of the membrane: a stretched square sheet, held along its edge, gives way to a load
/// that pulls it out of its plane and along it. Settled shapes on n, 2n and 4n cells a side,
/// compared at the vertices of the coarsest, give log2(|u_n - u_2n| / |u_2n - u_4n|). The middle's
/// sag under a small load across the plane is that of T lap w = -rho g.
namespace {

constexpr double k_side = 1.0;             ///< m
constexpr double k_strain = 0.05;          ///< strain of the stretched sheet
constexpr double k_space_stretch = 1000.0; ///< N/m

Scene held_scene(int cells, const Vec3& gravity) {
    Scene scene =
        vacuum_scene({k_side, k_side}, {cells, cells}, isotropic_fabric(k_space_stretch, 0.3, 0.0));
    scene.scene.gravity = gravity;
    ClothParams& cloth = scene.cloths[0];
    cloth.rest = RestShape::Uv;
    cloth.uv_scale = 1.0 / (1.0 + k_strain);
    cloth.pins.push_back({.loop = 0});
    return scene;
}

/// Positions at rest: a few substeps so long that inertia is nothing beside the stiffness.
std::vector<Vec3> settled(int cells, const Vec3& gravity) {
    FreeMotion motion(held_scene(cells, gravity));
    for (int i = 0; i < 3; ++i) {
        std::fill(motion.world.velocities.begin(), motion.world.velocities.end(), Vec3::Zero());
        motion.step(10.0);
    }
    return motion.world.positions;
}

/// Root mean square over the vertices of n cells of the space_distance between a mesh with `cells`
/// = n m and one with twice as many.
double
space_distance(const std::vector<Vec3>& coarse, int cells, const std::vector<Vec3>& fine, int n) {
    double sum = 0.0;
    const int skip = cells / n;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const int a = j * skip * (cells + 1) + i * skip;
            const int b = 2 * j * skip * (2 * cells + 1) + 2 * i * skip;
            sum += (coarse[static_cast<std::size_t>(a)] - fine[static_cast<std::size_t>(b)])
                       .squaredNorm();
        }
    }
    return std::sqrt(sum / ((n + 1) * (n + 1)));
}

ValidationRow space_order_row() {
    constexpr int n = 6;
    const Vec3 load(10.0, -30.0, 5.0); // m/s^2: sags by 3 % of the side
    const auto coarse = settled(n, load);
    const auto middle = settled(2 * n, load);
    const auto fine = settled(4 * n, load);
    return {.what = "order in space: displacement of a loaded membrane",
            .theory = 2.0,
            .measured = std::log2(space_distance(coarse, n, middle, n) /
                                  space_distance(middle, 2 * n, fine, n)),
            .tolerance = 0.15,
            .relative = false,
            .note = "stretched by 5 %; oblique load; 6; 12 and 24 cells a side"};
}

/// w(0) = 4 rho g a^2 / (pi^3 T) sum over odd m of (-1)^((m-1)/2) / m^3 (1 - 1 / cosh(m pi / 2)).
double middle_sag(double load_over_tension) {
    double sum = 0.0;
    for (int m = 1; m < 100; m += 2) {
        const double sign = m % 4 == 1 ? 1.0 : -1.0;
        sum += sign / std::pow(m, 3) * (1.0 - 1.0 / std::cosh(0.5 * m * std::numbers::pi));
    }
    return 4.0 * load_over_tension * k_side * k_side / std::pow(std::numbers::pi, 3) * sum;
}

ValidationRow sag_row() {
    constexpr double k_load = 0.1; // m/s^2: sags by 2e-5 of the side
    constexpr int n = 16;
    const double stretch = 1.0 + k_strain;
    const double tension = k_space_stretch / (1.0 - 0.3) * k_strain / stretch;
    const double load = isotropic_fabric(k_space_stretch, 0.3, 0.0).area_density * k_load;
    const auto positions = settled(n, Vec3(0.0, -k_load, 0.0));
    return {.what = "sag of a stretched square membrane under its weight",
            .unit = "m",
            .theory = middle_sag(load / (stretch * stretch) / tension),
            .measured = -positions[positions.size() / 2].y(),
            .tolerance = 0.01,
            .note = "strain 5 %; 16 x 16 cells"};
}

} // namespace

ValidationRows validate_order_in_space() {
    return {space_order_row(), sag_row()};
}

} // namespace weft
