#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace weft {

/// A sheet without bending stiffness hangs by its top edge and swings a little out of its plane:
/// (g z y')' + omega^2 y = 0 with z the height above the free edge. Its modes are J0(2 omega
/// sqrt(z / g)), and omega_k = j_0k / 2 sqrt(g / L) with j_0k the zeros of J0.
namespace {

constexpr double k_length = 1.0; ///< m
constexpr int k_cells = 20;
constexpr double k_dt = 0.002;    ///< s; BDF2 lengthens a period by (omega h)^2 / 3
constexpr double k_stretch = 1e5; ///< N/m: hangs 1e-5 longer than it is
constexpr double k_swing = 1e-4;  ///< m, at the free edge: the tension does not feel it
constexpr double k_bessel_zero[] = {2.4048255577, 5.5200781103};

/// A strip that hangs along z, so that its own rest plane is the plane it hangs in.
Scene hanging_scene() {
    Scene scene = vacuum_scene({k_length / k_cells, k_length}, {1, k_cells},
                               isotropic_fabric(k_stretch, 0.0, 0.0));
    scene.scene.gravity = Vec3(0.0, 0.0, k_earth_gravity);
    scene.scene.integrator = Integrator::Bdf2;
    scene.cloths[0].pins.push_back({.vertices = {0, 1}});
    return scene;
}

/// Height of vertex i above the free edge in the rest shape, m.
double rest_height(const World& world, std::size_t i) {
    return world.cloths[0].material_positions[i].y();
}

/// Stretches the strip as its weight does: u(s) = rho g / E (L s - s^2 / 2), s from the top.
void hang(World& world) {
    const double sag = world.cloths[0].params.fabric.area_density * k_earth_gravity / k_stretch;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        const double s = k_length - rest_height(world, i);
        world.positions[i].z() += sag * (k_length * s - 0.5 * s * s);
    }
}

/// Period of a mode, s, over two swings, seen through the mode's own shape.
double swing_period(double omega) {
    FreeMotion motion(hanging_scene());
    World& world = motion.world;
    hang(world);
    std::vector<double> shape(world.vertex_count());
    for (std::size_t i = 0; i < shape.size(); ++i) {
        shape[i] = std::cyl_bessel_j(0.0, 2.0 * omega *
                                              std::sqrt(rest_height(world, i) / k_earth_gravity));
        world.velocities[i].y() = k_swing * omega * shape[i];
    }
    const double periods = 2.3; // first rise at the start of the second swing
    const int substeps = static_cast<int>(periods * 2.0 * std::numbers::pi / (omega * k_dt));
    std::vector<double> swing;
    for (int n = 0; n < substeps; ++n) {
        motion.step(k_dt);
        double sum = 0.0;
        for (std::size_t i = 0; i < shape.size(); ++i) {
            sum += world.masses[i] * shape[i] * world.positions[i].y();
        }
        swing.push_back(sum);
    }
    return mean_period(swing, k_dt);
}

} // namespace

ValidationRows validate_hanging_periods() {
    ValidationRows rows;
    for (int k = 0; k < 2; ++k) {
        const double omega = 0.5 * k_bessel_zero[k] * std::sqrt(k_earth_gravity / k_length);
        rows.push_back({.what = fmt::format("period of a hanging sheet: mode {}", k + 1),
                        .unit = "s",
                        .theory = 2.0 * std::numbers::pi / omega,
                        .measured = swing_period(omega),
                        .tolerance = 0.01,
                        .note =
                            "length 1 m; 20 equal cells: a lumped chain is 0.07 % and 0.97 % slow; "
                            "BDF2; h 2 ms"});
    }
    return rows;
}

/// A square membrane, stretched alike in both directions and held along its edge, sounds in its
/// first mode at f = sqrt(T / rho) / (a sqrt 2): stiffness across the plane is tension alone.
namespace {

constexpr double k_side = 0.5;                ///< a, stretched, m
constexpr double k_strain = 0.05;             ///< T = E / (1 - nu) * strain a rest length
constexpr double k_membrane_stretch = 1000.0; ///< E, N/m
constexpr double k_poisson = 0.3;
constexpr int k_membrane_cells = 16;

Scene stretched_scene() {
    Scene scene = vacuum_scene({k_side, k_side}, {k_membrane_cells, k_membrane_cells},
                               isotropic_fabric(k_membrane_stretch, k_poisson, 0.0));
    scene.scene.integrator = Integrator::Bdf2;
    scene.scene.newton = 1; // small vibration of a linear system
    ClothParams& cloth = scene.cloths[0];
    cloth.rest = RestShape::Uv; // the pattern is smaller than what is held
    cloth.uv_scale = 1.0 / (1.0 + k_strain);
    cloth.pins.push_back({.loop = 0});
    return scene;
}

/// sqrt(T / rho) / (a sqrt 2) with T and rho of the stretched membrane, Hz.
double theory() {
    const double stretch = 1.0 + k_strain;
    const double density = isotropic_fabric(k_membrane_stretch, k_poisson, 0.0).area_density;
    const double tension = k_membrane_stretch / (1.0 - k_poisson) * k_strain / stretch;
    return std::sqrt(tension / (density / (stretch * stretch))) / (k_side * std::sqrt(2.0));
}

/// Hz, from a kick in the first mode.
double sounded(double period) {
    FreeMotion motion(stretched_scene());
    World& world = motion.world;
    std::vector<double> shape(world.vertex_count());
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const Vec3& x = world.positions[i];
        shape[i] = std::cos(std::numbers::pi * x.x() / k_side) *
                   std::cos(std::numbers::pi * x.z() / k_side);
        world.velocities[i].y() = 1e-5 * shape[i];
    }
    const double dt = period / 100.0; // BDF2 lengthens the period by (omega h)^2 / 3 = 0.13 %
    std::vector<double> swing;
    for (int n = 0; n < 230; ++n) {
        motion.step(dt);
        double sum = 0.0;
        for (std::size_t i = 0; i < shape.size(); ++i) {
            sum += world.masses[i] * shape[i] * world.positions[i].y();
        }
        swing.push_back(sum);
    }
    return 1.0 / mean_period(swing, dt);
}

} // namespace

ValidationRows validate_membrane_frequency() {
    return {{.what = "first frequency of a stretched square membrane",
             .unit = "Hz",
             .theory = theory(),
             .measured = sounded(1.0 / theory()),
             .tolerance = 0.01,
             .note = "strain 5 %; 16 x 16 cells; BDF2; 100 substeps a period"}};
}

} // namespace weft
