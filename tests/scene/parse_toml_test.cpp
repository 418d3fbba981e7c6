#include "base/error.h"
#include "scene/scene_reader.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

const std::string k_scene = "[[cloth]]\nname = \"shirt\"\ngrid = {}\nfabric = \"denim\"\n"
                            "[[cloth]]\nname = \"flag\"\ngrid = {}\n"
                            "[[cloth.pin]]\ncorners = true\n";

Scene read_with(const std::vector<std::string>& sets) {
    return read_scene_text(k_scene, "a.toml", "", sets);
}

std::string message_of(const std::string& set) {
    try {
        read_with({set});
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::BadInput);
        return error.what();
    }
    return "";
}

TEST(ApplySet, MakesATableThatIsMissing) {
    EXPECT_EQ(read_with({"scene.frames=10"}).scene.frames, 10);
}

TEST(ApplySet, TheLaterOfTwoHolds) {
    EXPECT_EQ(read_with({"scene.frames=10", "scene.frames=11"}).scene.frames, 11);
}

TEST(ApplySet, FindsAnObjectByNameIndexOrDottedIndex) {
    for (const char* path : {"cloth.flag", "cloth[1]", "cloth.1"}) {
        const Scene scene = read_with({std::string(path) + ".layer=3"});

        EXPECT_EQ(scene.cloths[0].layer, 0) << path;
        EXPECT_EQ(scene.cloths[1].layer, 3) << path;
    }
}

TEST(ApplySet, ReachesIntoArraysAndPins) {
    const Scene scene =
        read_with({"cloth.flag.pin[0].until=2", "render.size=[640,360]", "render.size[1]=480"});

    EXPECT_DOUBLE_EQ(scene.cloths[1].pins[0].until, 2.0);
    EXPECT_EQ(scene.render.size, (std::array<int, 2>{640, 480}));
}

TEST(ApplySet, ChangesOneNumberOfAPreset) {
    const FabricParams denim = read_with({}).cloths[0].fabric;

    const FabricParams fabric = read_with({"cloth.shirt.fabric.density=0.2"}).cloths[0].fabric;

    EXPECT_DOUBLE_EQ(fabric.area_density, 0.2);
    EXPECT_EQ(fabric.stretch_stiffness, denim.stretch_stiffness);
}

TEST(ApplySet, TakesAWordWithoutQuotesAsAString) {
    EXPECT_EQ(read_with({"render.map=viridis"}).render.map, "viridis");
    EXPECT_EQ(read_with({"render.map=\"turbo\""}).render.map, "turbo");
}

TEST(ApplySet, RefusalsNameTheOption) {
    EXPECT_EQ(message_of("scene.frames=0"),
              "--set scene.frames=0: scene.frames = 0: must be 1 to 1000000");
    EXPECT_EQ(message_of("scene.frame=1"),
              "--set scene.frame=1: scene.frame: unknown key; the nearest is frames");
    EXPECT_EQ(
        message_of("cloth.shirt.fabric.density=-1"),
        "--set cloth.shirt.fabric.density=-1: cloth[0].fabric.density = -1: must be > 0 kg/m^2");
    EXPECT_EQ(message_of("render.camera.fov_deg=20"),
              "--set render.camera.fov_deg=20: render.camera: needs eye and target");
    EXPECT_EQ(message_of("cloth.shrit.layer=1"),
              "--set cloth.shrit.layer=1: nothing there is named shrit; the nearest is shirt");
    EXPECT_EQ(message_of("cloth[2].layer=1"), "--set cloth[2].layer=1: index 2: must be below 2");
    EXPECT_EQ(message_of("obstacle.body.friction=1"),
              "--set obstacle.body.friction=1: there is no obstacle there");
    EXPECT_EQ(message_of("cloth.flag.name.x=1"),
              "--set cloth.flag.name.x=1: there is nothing below name");
    EXPECT_EQ(message_of("scene.frames"),
              "--set scene.frames: must be KEY=VALUE, as in scene.frames=10");
    EXPECT_EQ(message_of("scene..frames=1"),
              "--set scene..frames=1: must be KEY=VALUE, as in scene.frames=10 or "
              "cloth[0].fabric.bend=1e-5");
    EXPECT_EQ(message_of("cloth[x].layer=1"),
              "--set cloth[x].layer=1: an index in brackets must be a number from 0");
    EXPECT_TRUE(message_of("render.size=[640,")
                    .starts_with("--set render.size=[640,: the value is not TOML"));
}

} // namespace
} // namespace weft
