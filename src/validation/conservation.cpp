#include "step/advance.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace weft {

/// A sheet without forces from outside spins for a second. Nearly inextensible, each of its
/// vertices moves on a circle, and implicit Euler with angles f, f' of two successive substeps
/// obeys 2 sin f' = sin(f' + f), so that omega(t) = omega0 / sqrt(1 + 2 h omega0^2 t): it loses
/// angular momentum however well it converges. BDF2 keeps it to (omega h)^4 a substep once it has
/// started: its first substep is one of implicit Euler and takes (omega h)^2 / 2 of it, and once
/// the substeps that remember the first are over, 1.25 (omega h)^2 are gone (measured at 0.05).
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

/// Linear momentum: internal forces, dampers and contact between cloths change nothing of it. The
/// change is given relative to the sum of mass times speed.
namespace {

std::string name_of(Integrator integrator) {
    return integrator == Integrator::Euler ? "implicit Euler" : "BDF2";
}

double random_offset(std::mt19937& random) {
    return static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5;
}

/// A sheet with damping, pulled and kicked at random.
ValidationRow internal_row(Integrator integrator) {
    Scene scene = vacuum_scene({1.0, 1.0}, {8, 8}, isotropic_fabric(2000.0, 0.25, 1e-5));
    scene.scene.integrator = integrator;
    scene.scene.newton = 3; // momentum must not wait for convergence
    scene.scene.solver_tolerance = 1e-14;
    scene.cloths[0].fabric.damping = {0.0, 1e-3};
    FreeMotion motion(scene);
    World& world = motion.world;
    std::mt19937 random(11);
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        world.positions[i] +=
            5e-3 * Vec3(random_offset(random), random_offset(random), random_offset(random));
        world.velocities[i] +=
            Vec3(1.0 + random_offset(random), random_offset(random), random_offset(random));
    }
    const Vec3 before = linear_momentum(world);
    const double scale = speed_sum(world);
    double greatest = 0.0;
    for (int i = 0; i < 50; ++i) {
        motion.step(0.005);
        greatest = std::max(greatest, (linear_momentum(world) - before).norm() / scale);
    }
    return {.what = "change of momentum by internal forces: " + name_of(integrator),
            .measured = greatest,
            .tolerance = 1e-12,
            .relative = false,
            .note = "shaken free sheet with damping; 50 substeps"};
}

Scene colliding_scene(Integrator integrator) {
    Scene scene = vacuum_scene({0.4, 0.4}, {8, 8}, isotropic_fabric(500.0, 0.25, 1e-4));
    scene.scene.integrator = integrator;
    scene.scene.newton = 1;
    scene.scene.solver_tolerance = 1e-13;
    scene.scene.substeps = 4;
    scene.cloths[0].velocity = Vec3(0.0, 0.3, 0.0);
    ClothParams upper = scene.cloths[0];
    upper.name = "upper";
    upper.grid_size = Vec2(0.3, 0.3);
    upper.placement.translate = Vec3(0.02, 0.03, 0.01);
    upper.placement.rotate_deg = Vec3(4.0, 20.0, 3.0);
    upper.velocity = Vec3(0.2, -1.0, 0.0);
    scene.cloths.push_back(upper);
    return scene;
}

/// Two sheets that meet askew and rub: five frames, which see the blow and the parting.
ValidationRow collision_row(Integrator integrator) {
    const Scene scene = colliding_scene(integrator);
    World world = FreeMotion(scene).world;
    Stepper stepper({world, scene.scene, scene.contact});
    const Vec3 before = linear_momentum(world);
    const double scale = speed_sum(world);
    int contacts = 0;
    for (int frame = 0; frame < 5; ++frame) {
        contacts += stepper.advance_frame(world, nullptr)->contact.contacts_self;
    }
    const double change = (linear_momentum(world) - before).norm() / scale;
    const bool euler = integrator == Integrator::Euler;
    return {.what = "change of momentum of two sheets that collide: " + name_of(integrator),
            .measured = contacts > 0 ? change : std::numeric_limits<double>::quiet_NaN(),
            .tolerance = euler ? 1e-10 : 0.01,
            .relative = false,
            .note = euler ? "1.3 m/s; friction 0.3; 5 frames of 4 substeps"
                          : "the same; what is touched restarts from its average velocity"};
}

} // namespace

ValidationRows validate_momentum() {
    return {internal_row(Integrator::Euler), internal_row(Integrator::Bdf2),
            collision_row(Integrator::Euler), collision_row(Integrator::Bdf2)};
}

} // namespace weft
