#include <cmath>

#include "validation/experiments.h"
#include "validation/motion.h"

/// A sheet without forces from outside spins for a second. Nearly inextensible, each of its
/// vertices moves on a circle, and implicit Euler with angles f, f' of two successive substeps
/// obeys 2 sin f' = sin(f' + f), so that omega(t) = omega0 / sqrt(1 + 2 h omega0^2 t): it loses
/// angular momentum however well it converges. BDF2 keeps it to (omega h)^4 a substep once it has
/// started: its first substep is one of implicit Euler and takes (omega h)^2 / 2 of it, and once
/// the substeps that remember the first are over, 1.25 (omega h)^2 are gone (measured at 0.05).
namespace weft {

namespace {

constexpr double k_omega = 5.0; ///< rad/s
constexpr double k_dt = 0.01;   ///< s; omega h = 0.05
constexpr int k_substeps = 100;
constexpr int k_start = 10;       ///< substeps of BDF2 that remember its first: 3^-10 is left
constexpr double k_size = 0.2;    ///< m
constexpr double k_stretch = 2e4; ///< N/m: strains of rho omega^2 r^2 / E ~ 5e-6

Scene spinning_scene(Integrator integrator, double damping) {
    Scene scene = vacuum_scene({k_size, k_size}, {6, 6}, isotropic_fabric(k_stretch, 0.25, 1e-4));
    scene.scene.integrator = integrator;
    scene.cloths[0].fabric.damping = {0.0, damping};
    return scene;
}

void spin(World& world, const Vec3& omega) {
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.velocities[i] = omega.cross(world.positions[i]);
    }
}

double moment_of_inertia_y(const World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        const Vec3& x = world.positions[i];
        sum += world.masses[i] * (x.x() * x.x() + x.z() * x.z());
    }
    return sum;
}

/// omega after a second of spinning in its own plane, rad/s.
double spun_down(double damping) {
    FreeMotion motion(spinning_scene(Integrator::Euler, damping));
    spin(motion.world, k_omega * Vec3::UnitY());
    motion.steps(k_dt, k_substeps);
    return angular_momentum(motion.world).y() / moment_of_inertia_y(motion.world);
}

void curl(World& world, double radius) {
    for (Vec3& x : world.positions) {
        const double angle = x.z() / radius;
        x = Vec3(x.x(), radius * (std::cos(angle) - 1.0), radius * std::sin(angle));
    }
}

/// Share of the angular momentum that changes in a second, after the start, in a sheet that was
/// curled about x and tumbles about an axis askew to it: all dampers have something to brake.
double bdf2_loss(double damping) {
    FreeMotion motion(spinning_scene(Integrator::Bdf2, damping));
    curl(motion.world, 0.3);
    spin(motion.world, k_omega * Vec3(1.0, 2.0, 2.0) / 3.0);
    motion.steps(k_dt, k_start);
    const Vec3 before = angular_momentum(motion.world);
    motion.steps(k_dt, k_substeps);
    return (angular_momentum(motion.world) - before).norm() / before.norm();
}

} // namespace

ValidationRows validate_spin() {
    constexpr double t = k_dt * k_substeps;
    const double law = k_omega / std::sqrt(1.0 + 2.0 * k_dt * k_omega * k_omega * t);
    return {{.what = "spin after 1 s: implicit Euler",
             .unit = "rad/s",
             .theory = law,
             .measured = spun_down(0.0),
             .tolerance = 1e-3,
             .note = "omega0 5 rad/s; h 0.01 s; omega0 / sqrt(1 + 2 h omega0^2 t)"},
            {.what = "spin after 1 s: implicit Euler with damping",
             .unit = "rad/s",
             .theory = law,
             .measured = spun_down(1e-3),
             .tolerance = 1e-3,
             .note = "damping of 1e-3 s must not brake a rotation"},
            {.what = "change of angular momentum in 1 s: BDF2",
             .measured = bdf2_loss(0.0),
             .tolerance = 1e-3,
             .relative = false,
             .note = "curled sheet; omega h 0.05; after the start"},
            {.what = "change of angular momentum in 1 s: BDF2 with damping",
             .measured = bdf2_loss(0.02),
             .tolerance = 1e-3,
             .relative = false,
             .note = "the same; damping 0.02 s"}};
}

} // namespace weft
