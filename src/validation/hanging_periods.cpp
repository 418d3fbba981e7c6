#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "validation/experiments.h"
#include "validation/motion.h"

/// A sheet without bending stiffness hangs by its top edge and swings a little out of its plane:
/// (g z y')' + omega^2 y = 0 with z the height above the free edge. Its modes are J0(2 omega
/// sqrt(z / g)), and omega_k = j_0k / 2 sqrt(g / L) with j_0k the zeros of J0.
namespace weft {

namespace {

constexpr double k_g = 9.81;
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
    scene.scene.gravity = Vec3(0.0, 0.0, k_g);
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
    const double sag = world.cloths[0].params.fabric.area_density * k_g / k_stretch;
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
        shape[i] = std::cyl_bessel_j(0.0, 2.0 * omega * std::sqrt(rest_height(world, i) / k_g));
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
        const double omega = 0.5 * k_bessel_zero[k] * std::sqrt(k_g / k_length);
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

} // namespace weft
