#include "app/options.h"
#include "base/error.h"
#include "frames/frame.h"
#include "render/colour_map.h"
#include "scene/names.h"
#include "support/paths.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

namespace weft {
namespace {

/// What a verb with all options makes of a line.
struct Parsed {
    CommonOptions common;
    InputOptions inputs;

    explicit Parsed(const std::string& line) {
        CLI::App app;
        add_common_options(app, common);
        add_input_options(app, inputs);
        app.parse(line);
    }
};

const std::string k_scene = test::source_path("tests/scenes/hanging_sheet.toml").string();

TEST(Options, TakeTheirValuesFromTheLine) {
    const Parsed parsed("scene.toml -o out -f 2-8x3 -s a=1 --set b=[1,2] -j 2 --overwrite -n "
                        "--fail-on penetration --fail-on 'stretch_max>1.3' --verify -q");

    EXPECT_EQ(parsed.inputs.inputs, std::vector<std::filesystem::path>{"scene.toml"});
    EXPECT_EQ(parsed.common.out, "out");
    EXPECT_EQ(parsed.common.frames.step, 3);
    EXPECT_EQ(parsed.common.sets, (std::vector<std::string>{"a=1", "b=[1,2]"}));
    EXPECT_EQ(parsed.common.threads, 2);
    EXPECT_TRUE(parsed.common.overwrite);
    EXPECT_TRUE(parsed.common.dry_run);
    EXPECT_TRUE(parsed.common.verify);
    ASSERT_EQ(parsed.common.fail_on.size(), 2u);
    EXPECT_EQ(parsed.common.fail_on[1].column, "stretch_max");
    EXPECT_EQ(parsed.common.verbosity(), Verbosity::Quiet);
}

TEST(Options, AnOptionBeforeTheInputsTakesNoneOfThem) {
    const Parsed parsed("-s scene.frames=3 --pin top skirt.obj body.obj");

    EXPECT_EQ(parsed.common.sets, std::vector<std::string>{"scene.frames=3"});
    EXPECT_EQ(parsed.inputs.inputs.size(), 2u);
}

TEST(Options, ContradictionsAndBadValuesAreRefused) {
    EXPECT_THROW(Parsed("a.toml --resume --overwrite"), CLI::ParseError);
    EXPECT_THROW(Parsed("a.toml -q -v"), CLI::ParseError);
    EXPECT_THROW(Parsed("a.toml -j -1"), CLI::ParseError);
    EXPECT_THROW(Parsed("a.obj --up x"), CLI::ParseError);
    EXPECT_THROW(Parsed("-o out"), CLI::ParseError);
    EXPECT_THROW(Parsed("a.toml -f 5-3"), Error);
    EXPECT_THROW(Parsed("a.toml --fail-on nothing"), Error);
}

TEST(Options, ASceneFileTakesSetsAndHoldsTheFrames) {
    const Parsed parsed(k_scene + " -s scene.frames=4 -f 1-4");

    EXPECT_EQ(scene_of_command_line(parsed.inputs, parsed.common).scene.frames, 4);
    const Parsed too_far(k_scene + " -s scene.frames=4 -f 1-5");
    EXPECT_THROW(scene_of_command_line(too_far.inputs, too_far.common), Error);
}

TEST(Options, OfMeshFilesMeanNothingBesideASceneFile) {
    for (const char* more :
         {" body.obj", " --fabric denim", " --pin top", " --units cm", " --up z"}) {
        const Parsed parsed(k_scene + more);
        try {
            scene_of_command_line(parsed.inputs, parsed.common);
            ADD_FAILURE() << more;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::CommandLine) << more;
        }
    }
}

TEST(Options, AGarmentNeedsNoSceneFile) {
    const Parsed parsed("skirt.obj body.obj --pin top@body -s scene.frames=2");

    const Scene scene = scene_of_command_line(parsed.inputs, parsed.common);

    EXPECT_EQ(scene.scene.frames, 2);
    EXPECT_EQ(scene.cloths[0].fabric.name, "cotton");
    EXPECT_EQ(scene.obstacles[0].name, "body");
}

TEST(SceneNames, AreTheQuantitiesThatFramesHold) {
    ASSERT_EQ(k_quantity_names.size(), FrameObject{}.values.size());
    for (std::size_t i = 0; i < k_quantity_names.size(); ++i) {
        EXPECT_EQ(find_quantity(k_quantity_names[i]), static_cast<int>(i));
    }
}

TEST(SceneNames, AreTheColourMapsThatCanBeDrawn) {
    ASSERT_EQ(k_map_names.size(), colour_maps().size());
    for (const std::string_view name : k_map_names) {
        EXPECT_NE(find_colour_map(name), nullptr) << name;
    }
}

TEST(FrameRange, NamesItsFrames) {
    const FrameRange range = parse_frame_range("3-9x2");

    EXPECT_FALSE(range.contains(1));
    EXPECT_TRUE(range.contains(3));
    EXPECT_FALSE(range.contains(4));
    EXPECT_TRUE(range.contains(9));
    EXPECT_FALSE(range.contains(11));
}

TEST(FrameRange, OneNumberIsThatFrameAlone) {
    const FrameRange range = parse_frame_range("7");

    EXPECT_EQ(range.first, 7);
    EXPECT_EQ(range.last, 7);
}

TEST(FrameRange, HoldsAllFramesWhenNothingIsSaid) {
    EXPECT_TRUE(FrameRange{}.contains(1));
    EXPECT_TRUE(FrameRange{}.contains(100000));
}

TEST(FrameRange, RefusesWhatIsNoRange) {
    for (const char* text :
         {"", "0-3", "5-3", "1-", "-3", "1-3x", "1-3x0", "1-3x2y", "a-b", "99999999999"}) {
        EXPECT_THROW(parse_frame_range(text), Error) << text;
    }
}

TEST(FrameRange, MustEndWithinTheScene) {
    EXPECT_NO_THROW(check_frame_range(parse_frame_range("1-10"), 10));
    EXPECT_NO_THROW(check_frame_range(FrameRange{}, 10));
    EXPECT_THROW(check_frame_range(parse_frame_range("1-11"), 10), Error);
}

} // namespace
} // namespace weft
