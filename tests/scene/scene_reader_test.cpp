#include "scene/scene_reader.h"
#include "scene/scene_writer.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Scene read(const std::string& text, const std::vector<std::string>& sets = {}) {
    return read_scene_text(text, "a.toml", "", sets);
}

const std::string k_smallest = "[[cloth]]\nname = \"flag\"\ngrid = {}\n";

TEST(SceneReader, FillsInTheDefaultsOfTheFormat) {
    const Scene scene = read(k_smallest);

    EXPECT_EQ(scene.scene, SceneParams{});
    EXPECT_EQ(scene.contact, ContactParams{});
    EXPECT_EQ(scene.render, RenderParams{});
    ASSERT_EQ(scene.cloths.size(), 1u);
    ClothParams expected;
    expected.name = "flag";
    EXPECT_EQ(scene.cloths[0], expected);
}

TEST(SceneReader, ReadsWhatItWrote) {
    Scene scene = read(k_smallest);

    EXPECT_EQ(read(write_scene(scene, "")).cloths, scene.cloths);
}

} // namespace
} // namespace weft
