#include "scene/scene_reader.h"
#include "support/paths.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Scene read(const std::string& text) {
    return read_scene_text(text, "a.toml", "");
}

Scene every_key() {
    return read_scene(test::source_path("tests/scenes/every_key.toml"));
}

TEST(SceneReader, FillsInTheDefaultsOfTheFormat) {
    const Scene scene = read("[[cloth]]\nname = \"flag\"\ngrid = {}\n");

    EXPECT_EQ(scene.scene, SceneParams{});
    EXPECT_EQ(scene.contact, ContactParams{});
    EXPECT_EQ(scene.render, RenderParams{});
    ASSERT_EQ(scene.cloths.size(), 1u);
    ClothParams expected;
    expected.name = "flag";
    EXPECT_EQ(scene.cloths[0], expected);
}

TEST(SceneReader, ReadsEveryKeyOfTimeContactAndPictures) {
    const Scene scene = every_key();

    EXPECT_EQ(scene.scene.integrator, Integrator::Bdf2);
    EXPECT_EQ(scene.scene.frames, 12);
    EXPECT_DOUBLE_EQ(scene.scene.wind.x(), 1.5);
    EXPECT_FALSE(scene.contact.self);
    ASSERT_EQ(scene.contact.friction.size(), 2u);
    const FrictionPair expected_pair{{"shirt", "body"}, 0.25, 0.45};
    EXPECT_EQ(scene.contact.friction[0], expected_pair);
    EXPECT_EQ(scene.contact.friction[1].static_friction, std::nullopt);
    EXPECT_TRUE(scene.render.has_camera);
    EXPECT_DOUBLE_EQ(scene.render.camera.fov_deg, 40.0);
    EXPECT_EQ(scene.render.map, "seed");
}

TEST(SceneReader, ReadsEveryKeyOfCloth) {
    const Scene scene = every_key();

    ASSERT_EQ(scene.cloths.size(), 3u);
    const ClothParams& shirt = scene.cloths[0];
    EXPECT_EQ(shirt.mesh.objects, (std::vector<std::string>{"Front", "Back"}));
    EXPECT_DOUBLE_EQ(shirt.mesh.metres_per_unit, 0.01);
    EXPECT_TRUE(shirt.mesh.units_given);
    EXPECT_EQ(shirt.mesh.up, 'z');
    EXPECT_TRUE(shirt.mesh.repair);
    EXPECT_EQ(shirt.rest, RestShape::Uv);
    EXPECT_EQ(shirt.bend_model, BendModel::Quadratic);
    EXPECT_DOUBLE_EQ(shirt.grain_deg, 45.0);
    EXPECT_DOUBLE_EQ(shirt.pressure, 20.0);
    EXPECT_EQ(shirt.fabric.name, "mine");
    EXPECT_DOUBLE_EQ(shirt.fabric.stretch_stiffness[1], 1200.0);
    EXPECT_EQ(shirt.fabric.static_friction, 0.55);
    ASSERT_EQ(shirt.pins.size(), 4u);
    EXPECT_EQ(shirt.pins[0].vertices, (std::vector<Index>{0, 31}));
    EXPECT_DOUBLE_EQ(shirt.pins[0].until, 2.0);
    EXPECT_DOUBLE_EQ(shirt.pins[0].move[1][1], 0.5);
    EXPECT_TRUE(shirt.pins[1].has_box);
    EXPECT_EQ(shirt.pins[2].loop_side, "top");
    EXPECT_EQ(shirt.pins[2].to, "body");
    EXPECT_EQ(shirt.pins[3].loop, 1);
}

TEST(SceneReader, ReadsEveryKeyOfNets) {
    const Scene scene = every_key();

    ASSERT_EQ(scene.cloths.size(), 3u);
    EXPECT_EQ(scene.cloths[1].grid_cells, (std::array<int, 2>{8, 4}));
    const ClothParams& net = scene.cloths[2];
    EXPECT_EQ(net.model, Model::StvkEdge);
    EXPECT_EQ(net.spring.K1, 3000.0);
    EXPECT_EQ(net.spring.a2, 0.96);
    EXPECT_EQ(net.spring.limit, Vec2(0.9, 1.1));
    EXPECT_TRUE(net.spring.calibrate);
}

TEST(SceneReader, ReadsEveryKeyOfObstacles) {
    const Scene scene = every_key();

    ASSERT_EQ(scene.obstacles.size(), 7u);
    EXPECT_EQ(scene.obstacles[0].motion.size(), 2u);
    EXPECT_DOUBLE_EQ(scene.obstacles[0].motion[1].rotate_deg.y(), 90.0);
    const AnimationParams& dancer = scene.obstacles[1].animation;
    EXPECT_EQ(dancer.name, "Turn");
    EXPECT_DOUBLE_EQ(dancer.start, 0.5);
    EXPECT_DOUBLE_EQ(dancer.speed, 1.25);
    EXPECT_EQ(dancer.end, AnimationEnd::Loop);
    EXPECT_TRUE(scene.obstacles[2].animation.is_sequence);
    EXPECT_EQ(scene.obstacles[2].mesh.file, "runner/run.####.obj");
    EXPECT_DOUBLE_EQ(scene.obstacles[2].animation.fps, 60.0);
    EXPECT_EQ(scene.obstacles[3].animation.cache, "meshes/pole.pc2");
    EXPECT_EQ(scene.obstacles[4].shape, Shape::Sphere);
    EXPECT_EQ(scene.obstacles[5].shape, Shape::Box);
    EXPECT_EQ(scene.obstacles[6].shape, Shape::Plane);
}

TEST(SceneReader, ReadsEveryKeyOfSolids) {
    const Scene scene = every_key();

    ASSERT_EQ(scene.solids.size(), 2u);
    const SolidParams& cube = scene.solids[0];
    EXPECT_EQ(cube.box, Vec3(0.2, 0.4, 0.6));
    EXPECT_DOUBLE_EQ(cube.spacing, 0.1);
    EXPECT_DOUBLE_EQ(cube.placement.scale, 1.5);
    EXPECT_EQ(cube.velocity, Vec3(0.0, -2.0, 0.0));
    EXPECT_EQ(cube.model, Model::StvkEdge);
    EXPECT_DOUBLE_EQ(cube.thickness, 2e-3);
    EXPECT_EQ(cube.static_friction, 0.6);
    EXPECT_DOUBLE_EQ(cube.spring.shear, 0.5);
    EXPECT_DOUBLE_EQ(cube.spring.mass, 3.0);
    ASSERT_EQ(cube.pins.size(), 1u);
    EXPECT_DOUBLE_EQ(cube.pins[0].until, 3.0);
    EXPECT_FALSE(cube.fills_open);
    EXPECT_TRUE(scene.solids[1].fills_open);
    EXPECT_EQ(scene.solids[1].mesh.objects, std::vector<std::string>{"Bunny"});
}

TEST(SceneReader, ReadsEveryKeyOfRigidBodies) {
    const Scene scene = every_key();

    ASSERT_EQ(scene.rigids.size(), 3u);
    const RigidParams& ball = scene.rigids[0];
    EXPECT_EQ(ball.shape, Shape::Sphere);
    EXPECT_EQ(ball.radius, 0.2);
    EXPECT_EQ(ball.mass, 10.0);
    EXPECT_EQ(ball.placement.translate, Vec3(0.0, 3.0, 0.0));
    EXPECT_EQ(ball.velocity, Vec3(1.0, 0.0, -2.0));
    EXPECT_EQ(ball.spin_deg, Vec3(0.0, 90.0, 0.0));
    EXPECT_EQ(ball.thickness, 2e-3);
    EXPECT_EQ(ball.friction, 0.4);
    EXPECT_EQ(ball.static_friction, 0.6);
    EXPECT_EQ(scene.rigids[1].size, Vec3(0.2, 0.1, 0.3));
    EXPECT_EQ(scene.rigids[2].mesh.objects, std::vector<std::string>{"Anvil"});
}

TEST(SceneReader, TakesPathsRelativeToTheSceneFile) {
    const Scene scene = every_key();

    EXPECT_EQ(scene.base_dir, test::source_path("tests/scenes"));
}

TEST(SceneReader, LaysOverridesOverAPreset) {
    const std::string cloth = "[[cloth]]\nname = \"a\"\ngrid = {}\n";
    const FabricParams preset = read(cloth + "fabric = \"denim\"\n").cloths[0].fabric;

    const FabricParams altered =
        read(cloth + "fabric = { base = \"denim\", density = 0.5 }\n").cloths[0].fabric;

    FabricParams expected = preset;
    expected.name = "denim, altered";
    expected.area_density = 0.5;
    EXPECT_EQ(preset.name, "denim");
    EXPECT_EQ(altered, expected);
}

TEST(SceneReader, LetsStaticFrictionFollowUnlessBothAreGiven) {
    const std::string ball = "[[cloth]]\nname = \"a\"\ngrid = {}\n[[obstacle]]\nname = \"b\"\n"
                             "shape = \"sphere\"\n";

    EXPECT_EQ(read(ball + "friction = 0.5\n").obstacles[0].static_friction, std::nullopt);
    EXPECT_EQ(read(ball + "friction = 0.5\nstatic_friction = 0.7\n").obstacles[0].static_friction,
              0.7);
}

TEST(SceneReader, RefinesWhereTheTableIsThere) {
    const std::string sheet = "[[cloth]]\nname = \"a\"\ngrid = {}\n";

    EXPECT_EQ(read(sheet).cloths[0].adapt.levels, 0);
    EXPECT_EQ(read(sheet + "[cloth.adapt]\n").cloths[0].adapt.levels, k_default_levels);
    EXPECT_EQ(read(sheet + "[cloth.adapt]\nlevels = 0\n").cloths[0].adapt.levels, 0);
}

} // namespace
} // namespace weft
