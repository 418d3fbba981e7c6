#include "base/error.h"
#include "collide/crossings.h"
#include "scene/scene_reader.h"
#include "state/attachment.h"
#include "step/advance.h"
#include "support/worlds.h"

#include <gtest/gtest.h>

namespace weft {

using namespace test;

namespace {

/// Two sheets side by side in one plane, 4 cm apart, sewn along the gap in 0.4 s; the left one is
/// held by its far border. The right one has `cells` cells a side, the left one 6.
Scene strip(int cells, const std::string& more = "") {
    return read_scene_text(fmt::format(R"(
[scene]
frames = 100
air_density = 0.0
gravity = [0.0, 0.0, 0.0]
{1}
[[cloth]]
name = "left"
grid = {{ size = [0.3, 0.3], cells = [6, 6] }}
translate = [-0.17, 0.0, 0.0]
[[cloth.pin]]
box = {{ min = [-0.33, -0.1, -1.0], max = [-0.31, 0.1, 1.0] }}
[[cloth]]
name = "right"
grid = {{ size = [0.3, 0.3], cells = [{0}, {0}] }}
translate = [0.17, 0.0, 0.0]
[[attach]]
name = "middle"
kind = "seam"
a = {{ cloth = "left", from = [-0.02, 0.0, -0.15], to = [-0.02, 0.0, 0.15] }}
b = {{ cloth = "right", from = [0.02, 0.0, -0.15], to = [0.02, 0.0, 0.15] }}
close = 0.4
)",
                                       cells, more),
                           "x.toml", ".");
}

void advance(World& world, Stepper& stepper, int frames) {
    for (int i = 0; i < frames; ++i) {
        ASSERT_TRUE(stepper.advance_frame(world, nullptr));
    }
}

} // namespace

TEST(Sewing, ClosesAndWeldsBordersOfEqualAndUnequalFineness) {
    for (const int cells : {6, 8}) {
        const Scene scene = strip(cells);
        World world = build_quietly(scene);
        Stepper stepper({world, scene.scene, scene.contact});

        advance(world, stepper, 20); // 0.8 s

        const AttachmentReport report = measure_attachments(world);
        EXPECT_EQ(report.pairs, cells + 1);
        EXPECT_EQ(report.welded, report.pairs) << cells;
        EXPECT_LT(report.greatest_gap, 1e-5) << cells;
        EXPECT_TRUE(find_crossings(world, 1).empty()) << cells;
    }
}

TEST(Sewing, KeepsAWeldedSeamShutUnderLoad) {
    const Scene scene = strip(6, "");
    World world = build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});
    advance(world, stepper, 15);
    ASSERT_EQ(measure_attachments(world).welded, 7);
    SceneParams pulled = scene.scene;
    pulled.gravity = {9.81 * 100.0, 0.0, 0.0}; // 0.3 m of 0.15 kg/m^2: 44 N/m across the seam
    Stepper loaded({world, pulled, scene.contact});

    advance(world, loaded, 25);

    // A hundredth of what an edge of 5 cm stretches under 44 N/m at 1000 N/m, with half as much
    // again for the uneven load of the corners.
    const double gap = measure_attachments(world).greatest_gap;
    EXPECT_LT(gap, 1.5 * 0.01 * 0.05 * 44.0 / 1000.0 * 1.0);
    EXPECT_GT(gap, 0.0);
}

TEST(Sewing, KeepsMomentum) {
    Scene scene = strip(8);
    scene.cloths[0].pins.clear();
    scene.contact.enabled = false;
    scene.scene.solver_tolerance = 1e-10;
    World world = build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});

    advance(world, stepper, 6); // while it closes

    Vec3 momentum = Vec3::Zero();
    double scale = 0.0;
    for (std::size_t i = 0; i < world.vertex_count(); ++i) {
        momentum += world.masses[i] * world.velocities[i];
        scale += world.masses[i] * world.velocities[i].norm();
    }
    EXPECT_GT(scale, 1e-4);
    EXPECT_LT(momentum.norm(), 1e-8 * scale);
}

TEST(Sewing, GoesOnFromAnyFrameToTheSameBits) {
    const Scene scene = strip(8);
    World world = build_quietly(scene);
    const World start = world;
    Stepper stepper({world, scene.scene, scene.contact});
    advance(world, stepper, 8);
    World resumed = world;
    advance(world, stepper, 6); // welds on the way

    Stepper fresh({start, scene.scene, scene.contact});
    advance(resumed, fresh, 6);

    EXPECT_EQ(state_hash(resumed), state_hash(world));
    EXPECT_GT(measure_attachments(world).welded, 0);
}

TEST(Sewing, HoldsAButtonAThicknessOff) {
    Scene scene = read_scene_text(R"(
[scene]
air_density = 0.0
[[cloth]]
name = "wall"
grid = { size = [0.4, 0.4], cells = [8, 8] }
rotate_deg = [90.0, 0.0, 0.0]
[[cloth.pin]]
loop = 0
[[cloth]]
name = "patch"
grid = { size = [0.2, 0.2], cells = [5, 5] }
rotate_deg = [90.0, 0.0, 0.0]
translate = [0.0, 0.0, 0.01]
[[attach]]
name = "left"
kind = "button"
a = { cloth = "patch", at = [-0.07, 0.07, 0.01] }
b = { cloth = "wall" }
close = 0.1
[[attach]]
name = "right"
kind = "button"
a = { cloth = "patch", at = [0.07, 0.07, 0.01] }
b = { cloth = "wall" }
close = 0.1
)",
                                  "x.toml", ".");
    World world = build_quietly(scene);
    Stepper stepper({world, scene.scene, scene.contact});

    advance(world, stepper, 25);

    const AttachmentReport report = measure_attachments(world);
    EXPECT_EQ(report.welded, 2);
    EXPECT_LT(report.greatest_gap, 1e-4); // a tenth of the thickness
    EXPECT_TRUE(find_crossings(world, 1).empty());
}

} // namespace weft
