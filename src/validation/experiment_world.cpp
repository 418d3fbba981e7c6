#include "validation/experiment_world.h"

#include "base/error.h"
#include "forces/cloth_forces.h"
#include "geometry/curvature.h"
#include "state/build_world.h"
#include "step/constrained_vertices.h"

#include <limits>

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

Cloth& add_sheet(World& world,
                 const std::string& name,
                 const Sheet& sheet,
                 ClothParams params,
                 const std::function<Vec3(const Vec2&)>& place) {
    params.name = name;
    const ImportedMesh mesh = imported(sheet);
    Cloth& cloth = add_cloth(world, params, mesh);
    cloth.rest_areas = mixed_areas(mesh.mesh.positions, cloth.triangles); // to the last digit
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        const std::size_t v = at(cloth.first_vertex) + i;
        world.masses[v] = params.fabric.area_density * cloth.rest_areas[i];
        if (place) {
            world.positions[v] = world.previous_positions[v] = place(sheet.points[i]);
        }
    }
    return cloth;
}

World sheet_world(const Sheet& sheet,
                  const ClothParams& params,
                  const std::function<Vec3(const Vec2&)>& place) {
    World world;
    add_sheet(world, "sheet", sheet, params, place);
    return world;
}

SceneParams empty_space() {
    SceneParams params;
    params.gravity.setZero();
    params.air_density = 0.0;
    params.solver_tolerance = 1e-12;
    return params;
}

FabricParams isotropic_membrane(double modulus, double poisson) {
    FabricParams fabric;
    fabric.stretch_stiffness = Vec2(modulus, modulus);
    fabric.poisson = poisson;
    fabric.shear_stiffness = modulus / (2.0 * (1.0 + poisson));
    fabric.bend_stiffness = 0.0;
    return fabric;
}

std::vector<Index> vertices_where(const Sheet& sheet,
                                  const std::function<bool(const Vec2&)>& is_in) {
    std::vector<Index> picked;
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        if (is_in(sheet.points[i])) {
            picked.push_back(static_cast<Index>(i));
        }
    }
    return picked;
}

ClampedStrip::ClampedStrip(
    Pattern pattern, int cells, int cells_across, double length, double width)
    : sheet(make_sheet(pattern, cells + 1, cells_across, cells + 1, cells_across)),
      cell(length / (cells + 0.5)) {
    for (std::size_t i = 0; i < sheet.points.size(); ++i) {
        Vec2& p = sheet.points[i];
        if (i % static_cast<std::size_t>(cells + 2) == 1) {
            p = Vec2(1.0, std::round(p.y())); // the clamp's line is straight
        }
        p = Vec2((p.x() - 1.0) * cell, p.y() * width / cells_across);
    }
}

std::vector<Index> ClampedStrip::clamp() const {
    return vertices_where(sheet, [](const Vec2& p) { return p.x() < 1e-9; });
}

std::vector<Index> ClampedStrip::free_end() const {
    double end = 0.0;
    for (const Vec2& p : sheet.points) {
        end = std::max(end, p.x());
    }
    return vertices_where(sheet, [=](const Vec2& p) { return p.x() > end - 1e-9; });
}

int square_cells_across(int cells, double length, double width) {
    return std::max(1, static_cast<int>(std::lround(width / length * (cells + 0.5))));
}

} // namespace weft
