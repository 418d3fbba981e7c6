#include <fmt/core.h>

#include <cmath>

#include "validation/experiments.h"
#include "validation/motion.h"

/// The order of an integrator: a soft strip that hangs stretched by its weight is pushed out of its
/// plane and swings; its shape after 0.4 s with h, h/2 and h/4 gives
/// log2(|x_h - x_h/2| / |x_h/2 - x_h/4|).
namespace weft {

namespace {

constexpr double k_g = 9.81;
constexpr double k_length = 1.0;   ///< m
constexpr double k_stretch = 20.0; ///< N/m: slow enough for its vibrations to be resolved
constexpr double k_time = 0.4;     ///< s
constexpr int k_cells = 8;

std::vector<Vec3> swung(Integrator integrator, int substeps) {
    Scene scene =
        vacuum_scene({0.25, k_length}, {2, k_cells}, isotropic_fabric(k_stretch, 0.0, 1e-4));
    scene.scene.gravity = Vec3(0.0, 0.0, k_g);
    scene.scene.integrator = integrator;
    scene.scene.newton = 100;
    scene.cloths[0].pins.push_back({.vertices = {0, 1, 2}});
    FreeMotion motion(scene);
    World& world = motion.world;
    const double sag = scene.cloths[0].fabric.area_density * k_g / k_stretch;
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

} // namespace weft
