#include "base/error.h"
#include "scene/scene_from_files.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(SceneFromFiles, NamesObjectsByTheirFilesAndFollowsAnObstacle) {
    const Scene scene =
        scene_from_files({.garment = "a/my skirt.obj",
                          .obstacles = {"b/body.v2.fbx", "c/shoe.obj", "d/shoe.obj"},
                          .fabric = "denim",
                          .pins = {"top@body_v2"},
                          .units = "cm",
                          .up = "z"});

    ASSERT_EQ(scene.cloths.size(), 1u);
    EXPECT_EQ(scene.cloths[0].name, "my_skirt");
    EXPECT_EQ(scene.cloths[0].mesh.file, "a/my skirt.obj");
    EXPECT_DOUBLE_EQ(scene.cloths[0].mesh.metres_per_unit, 0.01);
    EXPECT_EQ(scene.cloths[0].mesh.up, 'z');
    EXPECT_EQ(scene.cloths[0].fabric.name, "denim");
    ASSERT_EQ(scene.cloths[0].pins.size(), 1u);
    EXPECT_EQ(scene.cloths[0].pins[0].loop_side, "top");
    EXPECT_EQ(scene.cloths[0].pins[0].to, "body_v2");
    ASSERT_EQ(scene.obstacles.size(), 3u);
    EXPECT_EQ(scene.obstacles[1].name, "shoe");
    EXPECT_EQ(scene.obstacles[2].name, "shoe_2");
}

TEST(SceneFromFiles, ReadsEveryKindOfPin) {
    const Scene scene = scene_from_files(
        {.garment = "a.obj",
         .pins = {"corners", "bottom", "loop:2", "vertices:0,31", "box:-1,0,-1,1,0.5,1"}});

    const std::vector<PinParams>& pins = scene.cloths[0].pins;
    ASSERT_EQ(pins.size(), 5u);
    EXPECT_TRUE(pins[0].corners);
    EXPECT_EQ(pins[1].loop_side, "bottom");
    EXPECT_EQ(pins[2].loop, 2);
    EXPECT_EQ(pins[3].vertices, (std::vector<Index>{0, 31}));
    EXPECT_EQ(pins[4].box_min, Vec3(-1.0, 0.0, -1.0));
    EXPECT_EQ(pins[4].box_max, Vec3(1.0, 0.5, 1.0));
}

TEST(SceneFromFiles, RefusesWhatIsNoPin) {
    for (const char* spec :
         {"", "corner", "loop", "loop:", "loop:1,2", "loop:x", "vertices:", "vertices:1,",
          "vertices:-1", "vertices:1.5", "box:1,2,3", "box:1,2,3,4,5,nan"}) {
        try {
            write_pin_spec(spec);
            ADD_FAILURE() << spec;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::CommandLine) << spec;
        }
    }
}

TEST(SceneFromFiles, TakesUnitsAsAWordOrANumber) {
    EXPECT_DOUBLE_EQ(
        scene_from_files({.garment = "a.obj", .units = "1e-3"}).cloths[0].mesh.metres_per_unit,
        1e-3);
    EXPECT_THROW(scene_from_files({.garment = "a.obj", .units = "2x"}), Error);
}

TEST(SceneFromFiles, ErrorsNameTheCommandLine) {
    try {
        scene_from_files({.garment = "a.obj", .fabric = "coton"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(
            error.what(),
            "command line: cloth[0].fabric = \"coton\": must be a preset (weft fabric list) or a "
            ".toml file; the nearest preset is cotton");
    }
}

} // namespace
} // namespace weft
