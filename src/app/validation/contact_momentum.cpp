#include "app/validation/contact_scene.h"
#include "app/validation/experiments.h"
#include "app/validation/motion.h"
#include "scene/pose.h"

#include <limits>

/// Momentum of two sheets that meet askew in empty space and rub: what one gains the other loses.
/// Changes are shares of the sum of mass times speed (times distance from the middle).
///
/// Angular momentum is asked of limp smooth sheets that meet slowly: implicit Euler brakes whatever
/// turns and is tense, friction between surfaces that keep a distance is a couple, and an impact
/// that is met within a substep counts from its start.
namespace weft {

namespace {

/// How fast the sheets meet (m/s), in how many substeps a frame, and for how many frames: the blow
/// and the parting.
struct Meeting {
    double speed;
    int substeps, frames;
};

World colliding_sheets(const SheetMesh& mesh, const FabricParams& fabric, double speed) {
    World world;
    ClothParams params;
    params.fabric = fabric;
    params.fabric.thickness = 1e-3;
    params.velocity = speed * Vec3(0.0, 0.2, 0.0);
    const int n = mesh.cells;
    add_cloth(world, "lower", make_sheet(mesh.pattern, n, n, 0.3, 0.3), params,
              lying(Vec2(0.3, 0.3), Vec3(0.0, -0.02, 0.0)));
    params.velocity = speed * Vec3(0.2, -0.8, 0.0);
    const auto flat = lying(Vec2(0.2, 0.2), Vec3::Zero());
    const Mat3 turn = rotation_from_degrees(Vec3(4.0, 20.0, 3.0));
    add_cloth(world, "upper", make_sheet(Pattern::Irregular, n, n, 0.2, 0.2), params,
              [&](const Vec2& p) { return Vec3(turn * flat(p) + Vec3(0.02, 0.02, 0.01)); });
    return world;
}

struct Change {
    double linear, angular; ///< NaN when the sheets did not meet
};

double moment_sum(const World& world) {
    double sum = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        sum += world.masses[i] * world.positions[i].norm() * world.velocities[i].norm();
    }
    return sum;
}

Change change_in(const Meeting& meeting, const SheetMesh& mesh, const FabricParams& fabric) {
    World world = colliding_sheets(mesh, fabric, meeting.speed);
    SceneParams space = contact_space(meeting.substeps);
    space.gravity.setZero();
    space.solver_tolerance = 1e-13;
    Stepper stepper(world, space, {});
    const Vec3 linear = linear_momentum(world);
    const Vec3 angular = angular_momentum(world);
    const double speeds = speed_sum(world);
    const double moments = moment_sum(world);
    int contacts = 0;
    for (int i = 0; i < meeting.frames; ++i) {
        contacts += stepper.advance_frame(world, {})->contact.contacts_self;
    }
    if (contacts == 0) {
        return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    }
    return {(linear_momentum(world) - linear).norm() / speeds,
            (angular_momentum(world) - angular).norm() / moments};
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
        const Change blow =
            change_in({1.2, substeps, 8}, mesh, isotropic_fabric(500.0, 0.25, 1e-4));
        rows.push_back(row("change of momentum", blow.linear, note));
        FabricParams limp = isotropic_fabric(1e-9, 0.25, 0.0);
        limp.friction = 0.0;
        const Change touch = change_in({0.1, 4 * substeps, 16}, mesh, limp);
        rows.push_back(row("change of momentum of limp smooth sheets", touch.linear, note));
        rows.push_back(
            row("change of angular momentum of limp smooth sheets", touch.angular, note));
    }
    return rows;
}

} // namespace weft
