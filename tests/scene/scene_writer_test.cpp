#include "scene/scene_reader.h"
#include "scene/scene_writer.h"
#include "support/paths.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Scene every_key() {
    return read_scene(test::source_path("tests/scenes/every_key.toml"));
}

void expect_equal(const Scene& a, const Scene& b) {
    EXPECT_EQ(a.scene, b.scene);
    EXPECT_EQ(a.contact, b.contact);
    EXPECT_EQ(a.cloths, b.cloths);
    EXPECT_EQ(a.solids, b.solids);
    EXPECT_EQ(a.rigids, b.rigids);
    EXPECT_EQ(a.obstacles, b.obstacles);
    EXPECT_EQ(a.attachments, b.attachments);
    EXPECT_EQ(a.render, b.render);
}

TEST(SceneWriter, WritesWhatReadsBackToTheSameBits) {
    const Scene scene = every_key();

    const std::string text = write_scene(scene, scene.base_dir);

    expect_equal(read_scene_text(text, "b.toml", scene.base_dir), scene);
}

TEST(SceneWriter, KeepsNumbersThatHaveNoShortForm) {
    Scene scene = every_key();
    scene.scene.gravity = {0.1 + 0.2, -1.0 / 3.0, 1e-300};
    scene.scene.fps = 1e22;
    scene.cloths[0].fabric.bend_stiffness = 5e-324;

    const std::string text = write_scene(scene, scene.base_dir);

    expect_equal(read_scene_text(text, "b.toml", scene.base_dir), scene);
}

TEST(SceneWriter, WritesTheSameTextAgain) {
    const Scene scene = every_key();
    const std::string text = write_scene(scene, scene.base_dir);

    EXPECT_EQ(write_scene(read_scene_text(text, "b.toml", scene.base_dir), scene.base_dir), text);
}

TEST(SceneWriter, RewritesPathsSoThatTheyHoldInAnotherFolder) {
    const Scene scene = every_key();
    const std::filesystem::path out = scene.base_dir / "runs" / "a";

    const Scene moved = read_scene_text(write_scene(scene, out), "b.toml", out);

    EXPECT_EQ(moved.cloths[0].mesh.file, "../../meshes/shirt.fbx");
    EXPECT_EQ((out / moved.obstacles[0].mesh.file).lexically_normal(),
              (scene.base_dir / scene.obstacles[0].mesh.file).lexically_normal());
}

TEST(SceneWriter, KeepsAnOddFileName) {
    Scene scene = every_key();
    scene.cloths[0].mesh.file = "a \"b\" \\ #\t.obj";

    const std::string text = write_scene(scene, scene.base_dir);

    expect_equal(read_scene_text(text, "b.toml", scene.base_dir), scene);
}

} // namespace
} // namespace weft
