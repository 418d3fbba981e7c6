#include "state/rigid_motion.h"
#include "step/advance.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

#include <numbers>

namespace weft {

using namespace test;

namespace {

constexpr double k_g = 9.81;

RigidParams body(const std::string& name, Shape shape, double mass, const Vec3& place) {
    RigidParams rigid;
    rigid.name = name;
    rigid.shape = shape;
    rigid.mass = mass;
    rigid.radius = 0.1;
    rigid.size = Vec3(0.2, 0.2, 0.2);
    rigid.placement.translate = place;
    return rigid;
}

std::size_t at_particle(const World& world, std::size_t rigid) {
    return static_cast<std::size_t>(world.rigids[rigid].body.first_particle);
}

ObstacleParams plane(double tilt_deg = 0.0) {
    ObstacleParams floor;
    floor.name = "floor";
    floor.shape = Shape::Plane;
    floor.size = Vec3(4.0, 1.0, 4.0);
    floor.placement.rotate_deg = Vec3(0.0, 0.0, tilt_deg);
    return floor;
}

/// A scene that runs and is looked at after every substep.
struct CheckedRun {
    explicit CheckedRun(const Scene& s)
        : scene(s), world(build_quietly(s)), stepper({world, s.scene, s.contact}) {
        stepper.verify_substeps(world);
    }
    void advance(int frames) {
        for (int i = 0; i < frames; ++i) {
            const auto report = stepper.advance_frame(world, {});
            EXPECT_EQ(report->crossings, 0);
            EXPECT_EQ(report->contact.unresolved, 0);
        }
    }
    Vec3 centre(std::size_t rigid) const {
        const FourPoints x = particles_of(world.rigids[rigid], world.positions);
        return 0.25 * (x[0] + x[1] + x[2] + x[3]);
    }

    Scene scene;
    World world;
    Stepper stepper;
};

Scene boxes_on_floor(double lower_mass, double upper_mass) {
    Scene scene;
    scene.obstacles.push_back(plane());
    scene.rigids.push_back(body("lower", Shape::Box, lower_mass, Vec3(0.0, 0.105, 0.0)));
    scene.rigids.push_back(body("upper", Shape::Box, upper_mass, Vec3(0.0, 0.31, 0.0)));
    scene.rigids[0].size = Vec3(0.25, 0.2, 0.24);
    scene.rigids[1].placement.rotate_deg = Vec3(0.0, 20.0, 0.0);
    return scene;
}

} // namespace

TEST(RigidContact, ABoxRestsOnABoxWhateverTheirMasses) {
    for (const auto& [lower, upper] :
         {std::pair{1.0, 1.0}, {1.0, 10.0}, {0.7, 5.0}, {1.0, 1000.0}}) {
        CheckedRun run(boxes_on_floor(lower, upper));

        run.advance(30);

        const double weight_energy = (lower + upper) * k_g * 0.2;
        EXPECT_LT(kinetic_energy(run.world), 1e-12 * weight_energy) << upper;
        // two gaps of nearly the thickness below the upper box
        EXPECT_NEAR(run.centre(1).y(), 0.302, 0.0004) << upper;
    }
}

TEST(RigidContact, BallsThatMeetKeepMomentum) {
    Scene scene;
    scene.scene.gravity.setZero();
    scene.scene.substeps = 40; // they meet within a way of 2 mm, on which arms are taken alike
    scene.rigids.push_back(body("a", Shape::Sphere, 1.0, Vec3(-0.15, 0.03, 0.0)));
    scene.rigids.push_back(body("b", Shape::Sphere, 3.0, Vec3(0.15, -0.03, 0.0)));
    scene.rigids[0].velocity = Vec3(2.0, 0.0, 0.0);
    scene.rigids[1].spin_deg = Vec3(0.0, 0.0, 200.0);
    CheckedRun run(scene);
    const Vec3 linear = linear_momentum(run.world);
    const Vec3 angular = angular_momentum(run.world);
    const double energy = kinetic_energy(run.world);

    run.advance(3);

    EXPECT_GT(run.world.velocities[at_particle(run.world, 1)].x(), 0.1); // it was hit
    EXPECT_LT((linear_momentum(run.world) - linear).norm(), 1e-8 * linear.norm());
    const double before = 2.0 * 0.03; // angular momentum of the first one's way, kg m^2/s
    EXPECT_LT((angular_momentum(run.world) - angular).norm(), 0.01 * before);
    EXPECT_LT(kinetic_energy(run.world), energy);
}

/// Coulomb: it slides where the tangent of the tilt is above the coefficient, with
/// a = g (sin - mu cos).
TEST(RigidContact, ABoxSlidesDownASlopeAsFrictionLets) {
    constexpr double mu = 0.3;
    for (const double tilt_deg : {15.0, 30.0}) { // atan 0.3 = 16.7 degrees
        const double tilt = tilt_deg * std::numbers::pi / 180.0;
        const Vec3 normal(-std::sin(tilt), std::cos(tilt), 0.0);
        const Vec3 down(-std::cos(tilt), -std::sin(tilt), 0.0);
        Scene scene;
        scene.obstacles.push_back(plane(tilt_deg));
        scene.rigids.push_back(body("box", Shape::Box, 2.0, 0.101 * normal));
        scene.rigids[0].placement.rotate_deg = Vec3(0.0, 0.0, tilt_deg);
        scene.rigids[0].friction = mu;
        scene.obstacles[0].friction = mu;
        CheckedRun run(scene);
        const Vec3 start = run.centre(0);

        run.advance(13);

        const double time = 13 * 0.04;
        const double h = 0.01;
        const double slope = k_g * (std::sin(tilt) - mu * std::cos(tilt));
        const double expected = slope > 0.0 ? 0.5 * slope * time * (time + h) : 0.0;
        EXPECT_NEAR((run.centre(0) - start).dot(down), expected, 2e-4 + 0.01 * expected)
            << tilt_deg;
    }
}

TEST(RigidContact, ABallRestsInAClothHeldAtItsEdge) {
    ClothParams sheet = record_sheet(12);
    sheet.grid_size = Vec2(0.6, 0.6);
    sheet.pins.push_back({.loop = 0});
    Scene scene = test::scene_of(sheet);
    scene.rigids.push_back(body("ball", Shape::Sphere, 1.0, Vec3(0.0, 0.105, 0.0)));
    scene.scene.air_density = 0.0;
    CheckedRun run(scene);

    run.advance(50);

    EXPECT_LT(kinetic_energy(run.world), 1e-3);
    EXPECT_LT(run.centre(0).y(), 0.09);
    EXPECT_LT(std::abs(run.centre(0).x()), 0.01);
}

/// The body hangs on two corners of the sheet: each pulls the other, so that what is free of
/// outside forces keeps its momentum.
TEST(RigidContact, ClothAndTheBodyItIsJoinedToPullEachOther) {
    ClothParams sheet = record_sheet(4);
    sheet.grid_size = Vec2(0.4, 0.4);
    sheet.velocity = Vec3(0.0, 1.0, 0.0);
    sheet.pins.push_back({.corners = true, .to = "box"});
    Scene scene = test::scene_of(sheet);
    scene.scene.gravity.setZero();
    scene.scene.air_density = 0.0;
    scene.rigids.push_back(body("box", Shape::Box, 0.5, Vec3(0.0, -0.3, 0.0)));
    CheckedRun run(scene);
    const Vec3 linear = linear_momentum(run.world);

    run.advance(10);

    EXPECT_LT((linear_momentum(run.world) - linear).norm(), 1e-9);
    EXPECT_GT(run.world.velocities[at_particle(run.world, 0)].y(), 0.01);
    for (const AttachedPair& pair : run.world.attached_pairs) {
        EXPECT_LT(pair_gap(pair, run.world.positions).norm(), 1e-3);
    }
}

} // namespace weft
