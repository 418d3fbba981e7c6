#include "step/advance.h"

#include <algorithm>
#include <limits>
#include <random>

#include "validation/experiments.h"
#include "validation/motion.h"

/// Linear momentum: internal forces, dampers and contact between cloths change nothing of it. The
/// change is given as a share of the sum of mass times speed.
namespace weft {

namespace {

std::string name_of(Integrator integrator) {
    return integrator == Integrator::Euler ? "implicit Euler" : "BDF2";
}

double random_share(std::mt19937& random) {
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
            5e-3 * Vec3(random_share(random), random_share(random), random_share(random));
        world.velocities[i] +=
            Vec3(1.0 + random_share(random), random_share(random), random_share(random));
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
