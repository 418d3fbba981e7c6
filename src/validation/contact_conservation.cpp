#include "forces/constant_bending.h"
#include "forces/membrane.h"
#include "geometry/shapes.h"
#include "scene/pose.h"
#include "validation/contact_scene.h"
#include "validation/experiment_world.h"
#include "validation/experiments.h"

#include <fmt/core.h>

#include <array>
#include <limits>

namespace weft {

/// Two sheets meet askew in empty space: the momentum that one gains the other loses. Changes are
/// relative to the sum of mass times speed (times distance from the middle).
///
/// Implicit Euler takes angular momentum from everything that turns and is tense. The moment of the
/// internal forces is therefore subtracted; the rest is the moment of contact on both sheets. The
/// sheets are smooth, as friction between surfaces at a distance is a couple, and slow, as an
/// impact within a substep counts from its start.
namespace {

struct Meeting {
    double speed; // m/s
    int substeps; // a frame
    double seconds;
    double friction;
    int newton;
};

World meeting_sheets(const Meeting& meeting, const SheetMesh& mesh) {
    World world;
    ClothParams params;
    params.fabric = isotropic_fabric(500.0, 0.25, 1e-4);
    params.fabric.thickness = 1e-3;
    params.fabric.friction = meeting.friction;
    params.velocity = meeting.speed * Vec3(0.0, 0.2, 0.0);
    const int n = mesh.cells;
    add_sheet(world, "lower", make_sheet(mesh.pattern, n, n, 0.3, 0.3), params,
              lying(Vec2(0.3, 0.3), Vec3(0.0, -0.02, 0.0)));
    params.velocity = meeting.speed * Vec3(0.2, -0.8, 0.0);
    const auto flat = lying(Vec2(0.2, 0.2), Vec3::Zero());
    const Mat3 turn = rotation_from_degrees(Vec3(4.0, 20.0, 3.0));
    add_sheet(world, "upper", make_sheet(Pattern::Irregular, n, n, 0.2, 0.2), params,
              [&](const Vec2& p) { return Vec3(turn * flat(p) + Vec3(0.02, 0.02, 0.01)); });
    return world;
}

/// Sum of position before the substep times force after it, of one cloth's internal forces, N m.
Vec3 internal_moment(const World& world, const Cloth& cloth, std::span<const Vec3> before) {
    Vec3 sum = Vec3::Zero();
    std::vector<Vec3> forces;
    const auto add = [&](std::span<const Index> nodes) {
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (nodes[i] != k_no_index) {
                sum += before[static_cast<std::size_t>(cloth.first_vertex + nodes[i])].cross(
                    forces[i]);
            }
        }
    };
    const MembraneElements membrane(cloth);
    forces.resize(membrane.nodes().size());
    membrane.forces(world.positions_of(cloth), world.velocities_of(cloth), forces);
    add(membrane.nodes());
    const ConstantBending bending(cloth);
    forces.resize(bending.nodes().size());
    bending.forces(world.positions_of(cloth), forces);
    add(bending.nodes());
    return sum;
}

double moment_sum(const World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += world.masses[i] * world.positions[i].norm() * world.velocities[i].norm();
    }
    return sum;
}

struct Change {
    double linear = 0.0, angular = 0.0; ///< NaN when the sheets did not meet
};

Change change_in(const Meeting& meeting, const SheetMesh& mesh) {
    World world = meeting_sheets(meeting, mesh);
    SceneParams space = contact_space(1);
    space.fps = k_frame_rate * meeting.substeps; // a frame is a substep
    space.gravity.setZero();
    space.newton = meeting.newton;
    space.solver_tolerance = 1e-13;
    Stepper stepper({world, space, {}});
    const Vec3 linear = linear_momentum(world);
    const double speeds = speed_sum(world);
    const double moments = moment_sum(world);
    Vec3 exerted = Vec3::Zero();
    int contacts = 0;
    while (world.time < meeting.seconds - 1e-9) {
        const std::vector<Vec3> before = world.positions;
        const Vec3 angular = angular_momentum(world);
        contacts += stepper.advance_frame(world, {})->contact.contacts_self;
        exerted += angular_momentum(world) - angular;
        for (const Cloth& cloth : world.cloths) {
            exerted -= internal_moment(world, cloth, before) / space.fps;
        }
    }
    if (contacts == 0) {
        return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    }
    return {(linear_momentum(world) - linear).norm() / speeds, exerted.norm() / moments};
}

ValidationRow row(std::string what, double change, std::string note) {
    return {.what = std::move(what),
            .measured = change,
            .tolerance = 1e-10,
            .relative = false,
            .note = std::move(note)};
}

} // namespace

ValidationRows validate_contact_momentum(bool thorough) {
    ValidationRows rows;
    for (const auto& [substeps, mesh] : repeats(thorough)) {
        const std::string note = name_of(Repeat{substeps, mesh});
        const Change blow = change_in({1.2, substeps, 0.32, 0.3, 1}, mesh);
        rows.push_back(row("change of momentum", blow.linear, note + "; 1.2 m/s"));
        const Change touch = change_in({0.1, 4 * substeps, 0.64, 0.0, 50}, mesh);
        rows.push_back(
            row("change of momentum without friction", touch.linear, note + "; 0.1 m/s"));
        rows.push_back(row("moment that contact exerts on both together", touch.angular,
                           note + "; without friction; 0.1 m/s"));
    }
    return rows;
}

/// Energy of cloth that touches resting bodies and itself: kinetic, elastic and of height, looked
/// at after every substep. Nothing does work on it, so that it can only fall, but for what contact
/// stores between two substeps. With one linearisation a substep the membrane itself can gain from
/// a sudden turn; solved to convergence, a gain is contact's.
namespace {

constexpr double k_thickness = 1e-3; // m
constexpr double k_seconds = 1.0;

ClothParams cloth_params() {
    ClothParams params;
    params.fabric = isotropic_fabric(500.0, 0.25, 1e-5);
    params.fabric.thickness = k_thickness;
    return params;
}

void add_square(World& world, const SheetMesh& mesh, double side, const Vec3& turn_deg, double y) {
    const int n = 2 * mesh.cells;
    const auto flat = lying(Vec2(side, side), Vec3::Zero());
    const Mat3 turn = rotation_from_degrees(turn_deg);
    add_sheet(world, fmt::format("sheet{}", world.cloths.size()),
              make_sheet(mesh.pattern, n, n, side, side), cloth_params(),
              [&](const Vec2& p) { return Vec3(turn * flat(p) + y * Vec3::UnitY()); });
}

World sheet_over_sphere(const SheetMesh& mesh) {
    World world;
    add_square(world, mesh, 0.3, Vec3(3.0, 10.0, 2.0), 0.15);
    add_body(world, "sphere", sphere_mesh(0.1), 0.3);
    return world;
}

World three_on_the_floor(const SheetMesh& mesh) {
    World world;
    for (int k = 0; k < 3; ++k) {
        add_square(world, mesh, 0.2, Vec3(2.0 * k, 15.0 * k, 1.0), 0.02 * (k + 1));
    }
    add_body(world, "floor", plane_mesh(Vec3(2.0, 0.0, 2.0)), 0.3);
    return world;
}

World meeting_squares(const SheetMesh& mesh) {
    World world;
    add_square(world, mesh, 0.3, Vec3::Zero(), -0.02);
    add_square(world, mesh, 0.2, Vec3(4.0, 20.0, 3.0), 0.02);
    const Cloth& upper = world.cloths[1];
    for (Index v = upper.first_vertex; v < upper.first_vertex + upper.vertex_count; ++v) {
        world.velocities[static_cast<std::size_t>(v)] = Vec3(0.2, -1.0, 0.0);
    }
    return world;
}

double energy(const World& world, const Vec3& gravity) {
    double sum = free_energy(world);
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum -= world.masses[i] * gravity.dot(world.positions[i]);
    }
    return sum;
}

/// The greatest rise of the energy above the least so far, as a fraction of the whole loss.
double greatest_return(World world, int substeps, int newton, const Vec3& gravity) {
    SceneParams space = contact_space(1);
    space.fps = k_frame_rate * substeps; // a frame is a substep
    space.gravity = gravity;
    space.newton = newton;
    Stepper stepper({world, space, {}});
    const double start = energy(world, gravity);
    double least = start;
    double greatest = 0.0;
    while (world.time < k_seconds - 1e-9) {
        stepper.advance_frame(world, {});
        const double now = energy(world, gravity);
        greatest = std::max(greatest, now - least);
        least = std::min(least, now);
    }
    return greatest / (start - least);
}

struct Case {
    const char* name;
    World (*build)(const SheetMesh&);
    double gravity; // m/s^2
};
constexpr std::array k_cases{
    Case{"sheet falls on a sphere", sheet_over_sphere, k_earth_gravity},
    Case{"three sheets fall on a floor", three_on_the_floor, k_earth_gravity},
    Case{"two sheets meet in empty space", meeting_squares, 0.0},
};

ValidationRow energy_row(const Case& one, const Repeat& repeat, int newton) {
    const auto& [pattern, cells] = repeat.mesh;
    return {.what = fmt::format("energy that came back: {}", one.name),
            .measured = greatest_return(one.build(repeat.mesh), repeat.substeps, newton,
                                        Vec3(0.0, -one.gravity, 0.0)),
            .tolerance = 1e-3,
            .relative = false,
            .note = fmt::format("newton {}; {} substeps; {} {} x {}", newton, repeat.substeps,
                                name_of(pattern), 2 * cells, 2 * cells)};
}

} // namespace

ValidationRows validate_contact_energy(bool thorough) {
    ValidationRows rows;
    for (const int newton : {10, 1}) {
        for (const Repeat& repeat : few_repeats(thorough)) {
            for (const Case& one : k_cases) {
                rows.push_back(energy_row(one, repeat, newton));
            }
        }
    }
    return rows;
}

} // namespace weft
