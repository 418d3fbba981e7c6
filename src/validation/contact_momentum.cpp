#include "forces/constant_bending.h"
#include "forces/membrane_elements.h"
#include "scene/pose.h"

#include <limits>

#include "validation/contact_scene.h"
#include "validation/experiments.h"
#include "validation/motion.h"

/// Momentum of two sheets that meet askew in empty space: what one gains the other loses. Changes
/// are shares of the sum of mass times speed (times distance from the middle).
///
/// Of angular momentum, implicit Euler takes something from whatever turns and is tense, so that
/// the moment of the internal forces is taken off and what contact exerts on both sheets together
/// is left. Smooth sheets: friction between surfaces that keep a distance is a couple. Slow ones:
/// an impact that is met within a substep counts from its start.
namespace weft {

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
    add_cloth(world, "lower", make_sheet(mesh.pattern, n, n, 0.3, 0.3), params,
              lying(Vec2(0.3, 0.3), Vec3(0.0, -0.02, 0.0)));
    params.velocity = meeting.speed * Vec3(0.2, -0.8, 0.0);
    const auto flat = lying(Vec2(0.2, 0.2), Vec3::Zero());
    const Mat3 turn = rotation_from_degrees(Vec3(4.0, 20.0, 3.0));
    add_cloth(world, "upper", make_sheet(Pattern::Irregular, n, n, 0.2, 0.2), params,
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

} // namespace weft
