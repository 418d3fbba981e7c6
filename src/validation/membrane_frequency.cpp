#include <cmath>
#include <numbers>

#include "validation/experiments.h"
#include "validation/motion.h"

/// A square membrane, stretched alike in both directions and held along its edge, sounds in its
/// first mode at f = sqrt(T / rho) / (a sqrt 2): stiffness across the plane is tension alone.
namespace weft {

namespace {

constexpr double k_side = 0.5;       ///< a, stretched, m
constexpr double k_strain = 0.05;    ///< T = E / (1 - nu) * strain a rest length
constexpr double k_stretch = 1000.0; ///< E, N/m
constexpr double k_poisson = 0.3;
constexpr int k_cells = 16;

Scene stretched_scene() {
    Scene scene = vacuum_scene({k_side, k_side}, {k_cells, k_cells},
                               isotropic_fabric(k_stretch, k_poisson, 0.0));
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
    const double density = isotropic_fabric(k_stretch, k_poisson, 0.0).area_density;
    const double tension = k_stretch / (1.0 - k_poisson) * k_strain / stretch;
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
