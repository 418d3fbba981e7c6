#include "base/parallel.h"
#include "collide/crossings.h"
#include "step/advance.h"
#include "support/contact_world.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

#include <random>

namespace weft {

namespace {

using namespace test;

/// A square sheet of `size` (m) at a height (m), 2 mm thick to contact.
ClothParams sheet(int cells, double size, double height) {
    ClothParams sheet = record_sheet(cells);
    sheet.grid_size = {size, size};
    sheet.fabric.thickness = 2e-3;
    sheet.placement.translate = {0.0, height, 0.0};
    return sheet;
}

/// A world that advances by substeps of a given length and nothing else.
struct SubstepRun {
    World world;
    SceneParams params;
    ContactParams contact;
    std::optional<Stepper> stepper; ///< made when the first substep begins

    SubstepRun(const Scene& scene, double dt)
        : world(build_quietly(scene)), params(scene.scene), contact(scene.contact) {
        params.fps = 1.0 / dt;
        params.substeps = 1;
        params.air_density = 0.0;
    }

    ContactReport advance() {
        if (!stepper) {
            stepper.emplace(Prepared(world, params, contact));
        }
        return stepper->advance_frame(world, nullptr)->contact;
    }
};

/// Sheet dropped onto a sphere above a floor, with the worst of what contact reported.
World sheet_over_sphere(int cells, int steps, ContactReport* worst = nullptr) {
    SubstepRun run(scene_of(sheet(cells, 1.0, 0.32)), 0.005);
    add_sphere(run.world, 0.3, Vec3::Zero());
    add_floor(run.world, 4.0, -0.5);
    for (int i = 0; i < steps; ++i) {
        const ContactReport report = run.advance();
        if (worst) {
            worst->unresolved = std::max(worst->unresolved, report.unresolved);
            worst->contacts_obstacle = std::max(worst->contacts_obstacle, report.contacts_obstacle);
            worst->min_gap = std::min(worst->min_gap, report.min_gap);
        }
    }
    return run.world;
}

} // namespace

TEST(ClothContact, SheetThatFallsOnAFloorComesToRestAtItsThickness) {
    SubstepRun run(scene_of(sheet(8, 0.4, 0.05)), 0.005);
    add_floor(run.world, 2.0, 0.0);

    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(run.advance().unresolved, 0);
    }

    for (const Vec3& x : run.world.positions) {
        EXPECT_NEAR(x.y(), 2e-3, 1e-4);
    }
    EXPECT_LT(kinetic_energy(run.world), 1e-9);
}

TEST(ClothContact, SheetOverASphereNeverCrosses) {
    ContactReport worst;

    const World world = sheet_over_sphere(24, 200, &worst);

    EXPECT_EQ(worst.unresolved, 0);
    EXPECT_GT(worst.contacts_obstacle, 0);
    EXPECT_GT(worst.min_gap, 1e-5);
    EXPECT_TRUE(find_crossings(world, 10).empty());
}

TEST(ClothContact, ResultIsTheSameForAnyThreadCount) {
    set_thread_count(1);
    const World one = sheet_over_sphere(16, 100);
    set_thread_count(2);
    const World two = sheet_over_sphere(16, 100);
    set_thread_count(0);

    ASSERT_EQ(one.positions.size(), two.positions.size());
    for (std::size_t i = 0; i < one.positions.size(); ++i) {
        ASSERT_EQ(one.positions[i], two.positions[i]) << i;
        ASSERT_EQ(one.velocities[i], two.velocities[i]) << i;
    }
}

TEST(ClothContact, TwoCollidingSheetsKeepTheirMomentum) {
    Scene scene = scene_of(sheet(8, 0.4, 0.01));
    scene.cloths.push_back(sheet(7, 0.4, -0.01));
    scene.cloths[1].name = "lower";
    scene.scene.gravity.setZero();
    scene.scene.solver_tolerance = 1e-13;
    SubstepRun run(scene, 0.002);
    World& world = run.world;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-0.5, 0.5);
    for (Vec3& v : world.velocities) {
        v = Vec3(noise(random), noise(random), noise(random));
    }
    for (Index i = 0; i < world.cloths[0].vertex_count; ++i) {
        world.velocities[static_cast<std::size_t>(i)].y() -= 4.0;
    }
    const Vec3 before = linear_momentum(world);

    int contacts = 0;
    for (int i = 0; i < 10; ++i) {
        const ContactReport report = run.advance();
        contacts += report.contacts_self;
        EXPECT_EQ(report.unresolved, 0);
    }

    EXPECT_GT(contacts, 0);
    EXPECT_LT((linear_momentum(world) - before).norm(), 1e-10);
}

TEST(ClothContact, FastSphereDoesNotTunnelASheet) {
    Scene scene = scene_of(sheet(16, 1.0, 0.0));
    scene.scene.gravity.setZero();
    SubstepRun run(scene, 0.005);
    Obstacle& ball = add_sphere(run.world, 0.1, {0.0, -0.3, 0.0}, 2);
    ball.params.motion = {{.t = 0.0}, {.t = 0.05, .translate = {0.0, 1.0, 0.0}}}; // 20 m/s

    for (int i = 0; i < 12; ++i) {
        ASSERT_EQ(run.advance().unresolved, 0) << i;
        ASSERT_TRUE(find_crossings(run.world, 1).empty()) << i;
    }

    const auto middle = static_cast<std::size_t>(8 * 17 + 8);
    EXPECT_GT(run.world.positions[middle].y(), 0.7 + 0.1); // above the ball's top at y = 0.8
}

TEST(ClothContact, FastGrowingSpikeDoesNotTunnelASheet) {
    // A ball whose upper half shoots up at 20 m/s, 0.1 m a substep, and is pulled back as fast.
    Scene scene = scene_of(sheet(16, 1.0, 0.0));
    scene.scene.gravity.setZero();
    SubstepRun run(scene, 0.005);
    Obstacle& ball = add_sphere(run.world, 0.1, {0.0, -0.3, 0.0}, 2);
    const std::vector<Vec3> rest = ball.mesh.positions;
    ball.deformation =
        std::make_shared<Deformation>(rest.size(), 0, [rest](double t, std::span<Vec3> positions) {
            const double rise = 20.0 * std::min(t, 0.06 - t);
            for (std::size_t i = 0; i < rest.size(); ++i) {
                positions[i] = rest[i] + std::max(0.0, rest[i].y() / 0.1) * rise * Vec3::UnitY();
            }
        });

    double highest = 0.0;
    for (int i = 0; i < 12; ++i) {
        ASSERT_EQ(run.advance().unresolved, 0) << i;
        ASSERT_TRUE(find_crossings(run.world, 1).empty()) << i;
        highest = std::max(highest, run.world.positions[8 * 17 + 8].y());
    }

    EXPECT_GT(highest, 0.4); // the tip reaches y = -0.2 + 0.6
}

TEST(ClothContact, ThatStartsTooNearDoesNotJump) {
    SubstepRun run(scene_of(sheet(6, 0.3, 1e-4)), 0.001); // 1.9 mm too near
    add_floor(run.world, 2.0, 0.0);

    double fastest = 0.0;
    for (int i = 0; i < 400; ++i) {
        run.advance();
        for (const Vec3& v : run.world.velocities) {
            fastest = std::max(fastest, v.norm());
        }
    }

    EXPECT_LT(fastest, 0.05); // 20 1/s times 1.9 mm, and nothing on top
    EXPECT_NEAR(run.world.positions[0].y(), 2e-3, 1e-4);
}

TEST(ClothContact, OfFlatClothAtRestIsNone) {
    Scene scene = scene_of(sheet(10, 0.01, 0.0)); // cells of 1 mm, thickness 2 mm
    scene.scene.gravity.setZero();
    SubstepRun run(scene, 0.005);

    const ContactReport report = run.advance();

    EXPECT_EQ(report.contacts_self, 0);
    EXPECT_EQ(report.impacts, 0);
}

} // namespace weft
