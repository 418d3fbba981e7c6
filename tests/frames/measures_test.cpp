#include "frames/cache.h"
#include "frames/capture.h"
#include "frames/measures.h"
#include "frames/statistics.h"
#include "scene/scene_reader.h"
#include "state/build_world.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// A grid of the model, strained along x and y of the sheet.
World strained_grid(const std::string& model, double along_x, double along_z) {
    World world = build_world(
        read_scene_text("[[cloth]]\nname = \"net\"\ngrid = { size = [0.4, 0.4], cells = [4, 4] }\n"
                        "model = \"" +
                            model + "\"\n[cloth.spring]\nK = 500.0\nbend = 10.0\n",
                        "a.toml", "."),
        [](const std::string&) {});
    for (Vec3& x : world.positions) {
        x = Vec3(along_x * x.x(), x.y(), along_z * x.z());
    }
    return world;
}

TEST(EdgeMeasures, StretchIsLengthOverRestLengthOfSidesAndDiagonals) {
    const World world = strained_grid("linear", 1.2, 0.9);

    const StrainStatistics strain = measure_strain(world);

    EXPECT_NEAR(strain.stretch_max, 1.2, 1e-12);
    EXPECT_NEAR(strain.stretch_min, 0.9, 1e-12);
    const double diagonal = std::sqrt((1.2 * 1.2 + 0.9 * 0.9) / 2.0);
    EXPECT_NEAR(strain.stretch_mean, (20.0 * 1.2 + 20.0 * 0.9 + 32.0 * diagonal) / 72.0, 1e-12);
}

TEST(EdgeMeasures, EnergyIsThatOfSpringsSummedByHand) {
    const World world = strained_grid("linear", 1.2, 1.0);

    const MotionStatistics motion = StatisticsCollector(world, {}).measure(world, {}, 0).motion;

    const double diagonal = 0.1 * (std::sqrt(1.2 * 1.2 + 1.0) - std::sqrt(2.0));
    EXPECT_NEAR(motion.membrane, 0.5 * 500.0 * (20.0 * 0.02 * 0.02 + 32.0 * diagonal * diagonal),
                1e-12);
    EXPECT_NEAR(motion.bending, 0.5 * 10.0 * 15.0 * 0.04 * 0.04, 1e-12);
}

TEST(EdgeMeasures, VerticesHaveTheMeanOfTheirEdges) {
    const World world = strained_grid("cubic", 1.1, 1.1);

    const Frame frame = FrameCapture(world, 25.0, 1).capture(world);

    const auto quantity = static_cast<std::size_t>(find_quantity("stretch"));
    for (const float stretch : frame.objects[0].values[quantity]) {
        EXPECT_NEAR(stretch, 1.1, 1e-6);
    }
}

/// A cube of 0.16 m in 729 particles, turned.
Scene cube_scene() {
    Scene scene;
    SolidParams params{.name = "cube", .box = Vec3::Constant(0.16)};
    params.placement = {{0.3, 1.0, -0.2}, {10.0, 20.0, 30.0}, 1.0};
    params.spring.mass = 0.71;
    scene.solids.push_back(params);
    return scene;
}

World cube_world() {
    return build_world(cube_scene(), [](const std::string&) {});
}

/// Maps all particles and carries the surface along.
template <typename F> void move(World& world, const F& f) {
    const Body& body = world.solids[0].body;
    for (Index p = 0; p < body.particle_count; ++p) {
        Vec3& x = world.positions[static_cast<std::size_t>(body.first_particle + p)];
        x = f(x);
    }
    interpolate_embedded(world, world.positions);
}

FrameStatistics measure(const World& world) {
    return StatisticsCollector(world, SceneParams{}).measure(world, {}, 0);
}

constexpr double k_volume = 0.16 * 0.16 * 0.16;

TEST(SolidMeasures, OfACubeAtRest) {
    const World world = cube_world();
    const FrameStatistics statistics = measure(world);

    EXPECT_NEAR(statistics.volume, k_volume, 1e-15);
    EXPECT_EQ(statistics.inverted_cells, 0u);
    EXPECT_NEAR(statistics.strain.stretch_min, 1.0, 1e-12);
    EXPECT_NEAR(statistics.strain.stretch_max, 1.0, 1e-12);
    EXPECT_NEAR(statistics.motion.membrane, 0.0, 1e-12);
    EXPECT_NEAR(statistics.motion.gravity, 0.71 * 9.81 * 1.0, 1e-12);
}

TEST(SolidMeasures, OfACubeStretchedAlike) {
    World world = cube_world();
    move(world, [](const Vec3& x) { return Vec3(1.1 * x); });
    const FrameStatistics statistics = measure(world);

    EXPECT_NEAR(statistics.volume, 1.1 * 1.1 * 1.1 * k_volume, 1e-14);
    EXPECT_NEAR(statistics.strain.stretch_min, 1.1, 1e-12);
    EXPECT_NEAR(statistics.strain.stretch_mean, 1.1, 1e-12);
    for (const double stretch : surface_stretches(world, world.solids[0])) {
        EXPECT_NEAR(stretch, 1.1, 1e-12);
    }
    // Cubic, K1 = 6 K, K2 = 2 K at 10 %: E = K L^2 (s^2/2 + p s^3/6 + q s^4/12), p = 20, q = 300.
    const double share = 0.005 + 20.0 / 6.0 * 1e-3 + 300.0 / 12.0 * 1e-4;
    const double lengths = 4e-4 * (1944.0 + 2.0 * 3456.0 + 3.0 * 2048.0); // sum of L^2
    EXPECT_NEAR(statistics.motion.membrane, 1000.0 * share * lengths, 1e-9);
}

TEST(SolidMeasures, MirroredCubeIsInvertedThroughout) {
    World world = cube_world();
    move(world, [](const Vec3& x) { return Vec3(-x.x(), x.y(), x.z()); });
    const FrameStatistics statistics = measure(world);

    EXPECT_EQ(statistics.inverted_cells, 512u);
    EXPECT_NEAR(statistics.volume, -k_volume, 1e-15);
}

TEST(SolidMeasures, OneParticlePushedThroughItsCellsInvertsThoseAroundIt) {
    World world = cube_world();
    const Body& body = world.solids[0].body;
    const Index inner = 4 + 9 * (4 + 9 * 4);
    auto& x = world.positions[static_cast<std::size_t>(body.first_particle + inner)];
    const Vec3 next = world.positions[static_cast<std::size_t>(body.first_particle + inner + 1)];

    x += 0.9 * (next - x);
    EXPECT_EQ(count_inverted_cells(world, world.solids[0]), 0u);
    x += 2.0 * (next - x); // 1.1 cells on
    EXPECT_EQ(count_inverted_cells(world, world.solids[0]), 4u);
}

TEST(SolidMeasures, BodyWithAHoleHoldsWhatAFanOverItCloses) {
    World world = cube_world();
    Body body = world.solids[0].body;
    std::erase_if(body.triangles, [&](const Triangle& t) { // the face at low x: flat
        return std::all_of(t.begin(), t.end(), [&](Index v) {
            const Index particle = body.embeddings[static_cast<std::size_t>(v)].particles[0];
            return particle % 9 == 0;
        });
    });
    body.topology = build_edges(body.triangles);

    EXPECT_EQ(body.triangles.size(), 5u * 128u);
    EXPECT_NEAR(body_volume(world, body), k_volume, 1e-15);
}

TEST(SolidMeasures, CacheGivesBackWhatWasCaptured) {
    const test::TempFolder folder;
    World world = cube_world();
    move(world, [](const Vec3& x) { return Vec3(x.x(), 0.9 * x.y(), x.z()); });
    world.velocities.assign(world.vertex_count(), Vec3(0.0, -3.0, 4.0));
    const Scene scene = cube_scene();
    const FrameCapture capture(world, scene.scene.fps);
    const Frame live = capture.capture(world);

    const RunPaths paths{folder.path()};
    std::filesystem::create_directories(paths.cache_dir());
    write_cache(paths, live);
    const CachedRun run(folder.path(), scene);
    const Frame read = run.read(1);

    EXPECT_EQ(run.frames(), std::vector<int>{1});
    ASSERT_EQ(read.objects.size(), 1u);
    EXPECT_EQ(read.objects[0].kind, ObjectKind::Solid);
    EXPECT_EQ(read.objects[0].name, "cube");
    EXPECT_EQ(read.objects[0].positions, live.objects[0].positions);
    EXPECT_EQ(read.objects[0].triangles, live.objects[0].triangles);
    EXPECT_EQ(read.objects[0].values, live.objects[0].values);
    const auto& speed = read.objects[0].values[static_cast<std::size_t>(find_quantity("speed"))];
    ASSERT_EQ(speed.size(), 386u);
    EXPECT_FLOAT_EQ(speed[7], 5.0F);
    EXPECT_TRUE(read.objects[0].values[static_cast<std::size_t>(find_quantity("shear"))].empty());
}

} // namespace
} // namespace weft
