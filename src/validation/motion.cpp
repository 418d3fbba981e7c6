#include "validation/motion.h"

#include "base/error.h"
#include "forces/cloth_forces.h"
#include "state/build_world.h"
#include "step/constrained_vertices.h"

#include <limits>

#include "validation/sheet_world.h"

namespace weft {

namespace {

[[noreturn]] void refuse_warning(const std::string& line) {
    throw Error(ExitCode::OurFault, line);
}

} // namespace

FreeMotion::FreeMotion(const Scene& scene)
    : world(build_world(scene, refuse_warning)), params_(scene.scene), implicit_(world, params_) {}

void FreeMotion::step(double dt) {
    find_constrained(world, world.time + dt, constrained_);
    if (!implicit_.solve(world, constrained_, dt, end_positions_, end_velocities_).converged) {
        throw Error(ExitCode::Diverged, fmt::format("no convergence at t = {:.6g} s", world.time));
    }
    std::swap(world.previous_positions, world.positions);
    std::swap(world.previous_velocities, world.velocities);
    std::swap(world.positions, end_positions_);
    std::swap(world.velocities, end_velocities_);
    world.history_dt = params_.integrator == Integrator::Bdf2 ? dt : 0.0;
    world.time += dt;
}

void FreeMotion::steps(double dt, int count) {
    for (int i = 0; i < count; ++i) {
        step(dt);
    }
}

FabricParams isotropic_fabric(double stretch, double poisson, double bend) {
    FabricParams fabric = isotropic_membrane(stretch, poisson);
    fabric.area_density = 0.2;
    fabric.bend_stiffness = bend;
    return fabric;
}

Scene vacuum_scene(const Vec2& size, const std::array<int, 2>& cells, const FabricParams& fabric) {
    Scene scene;
    scene.scene.gravity.setZero();
    scene.scene.air_density = 0.0;
    scene.scene.newton = 50;
    scene.scene.solver_tolerance = 1e-12;
    ClothParams& cloth = scene.cloths.emplace_back();
    cloth.name = "sheet";
    cloth.grid_size = size;
    cloth.grid_cells = cells;
    cloth.fabric = fabric;
    return scene;
}

double free_energy(const World& world) {
    double sum = kinetic_energy(world);
    for (const Cloth& cloth : world.cloths) {
        sum += elastic_energy(cloth, world.positions_of(cloth));
    }
    return sum;
}

double mean_period(std::span<const double> signal, double dt) {
    double first = 0.0;
    double last = 0.0;
    int rises = 0;
    for (std::size_t i = 1; i < signal.size(); ++i) {
        if (signal[i - 1] < 0.0 && signal[i] >= 0.0) {
            const double weight = -signal[i - 1] / (signal[i] - signal[i - 1]);
            last = dt * (static_cast<double>(i) + weight);
            first = rises++ == 0 ? last : first;
        }
    }
    return rises < 2 ? std::numeric_limits<double>::quiet_NaN() : (last - first) / (rises - 1);
}

} // namespace weft
