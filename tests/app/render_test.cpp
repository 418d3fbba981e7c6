#include "app/commands.h"
#include "base/atomic_file.h"
#include "frames/cache.h"
#include "frames/csv.h"
#include "scene/names.h"
#include "support/golden.h"
#include "support/paths.h"
#include "support/picture_frames.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <set>
#include <span>

namespace weft {
namespace {

const std::string k_scene = R"(
[scene]
frames = 3
[[cloth]]
name = "tablecloth"
grid = { size = [1.2, 1.2], cells = [12, 12] }
[[obstacle]]
name = "ball"
shape = "sphere"
radius = 0.3
[render]
size = [160, 90]
supersample = 1
)";

/// What a simulation of three frames leaves: the cloth sinks by a centimetre a frame.
void write_run(const std::filesystem::path& folder) {
    const RunPaths paths{folder};
    std::filesystem::create_directories(paths.cache_dir());
    test::write_file(paths.scene(), k_scene);
    write_obstacles(paths, {{.shape = test::ball(0.3, 12), .origin = Vec3::Zero(), .motion = {}}});
    for (int number = 1; number <= 3; ++number) {
        Frame frame;
        frame.number = number;
        frame.objects = {test::draped_cloth(12)};
        frame.objects[0].material_positions.resize(frame.objects[0].positions.size());
        for (Vec3f& x : frame.objects[0].positions) {
            x.y() -= 0.01F * static_cast<float>(number);
        }
        write_cache(paths, frame);
    }
}

int render(std::vector<std::string> arguments) {
    std::vector<const char*> argv{"weft", "render", "-q"};
    for (const std::string& argument : arguments) {
        argv.push_back(argument.c_str());
    }
    return run_command_line(static_cast<int>(argv.size()), argv.data());
}

TEST(Render, HelpAndDocumentationNameEveryQuantityAndColourMap) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(render({"--help"}), 0);
    const std::string help = testing::internal::GetCapturedStdout();
    const std::string page = read_file(test::source_path("docs/scene-keys.md"));

    for (const auto& names : {std::span<const std::string_view>(k_quantity_names),
                              std::span<const std::string_view>(k_map_names)}) {
        for (const std::string_view name : names) {
            EXPECT_NE(help.find(name), std::string::npos) << name;
            EXPECT_NE(page.find(name), std::string::npos) << name;
        }
    }
}

TEST(Render, DrawsEveryFrameOfARunWithItsTable) {
    const test::TempFolder folder;
    write_run(folder / "run");

    ASSERT_EQ(render({(folder / "run").string()}), 0);

    const RunPaths paths{folder / "run"};
    for (int number = 1; number <= 3; ++number) {
        const Image image = test::decode_png(read_file(paths.picture(number)));
        EXPECT_EQ(image.width, 160);
        EXPECT_EQ(image.height, 90);
    }
    const CsvTable table = parse_csv(read_file(paths.images()), "images.csv");
    ASSERT_EQ(table.rows.size(), 3U);
    for (std::size_t row = 0; row < 3; ++row) {
        EXPECT_GT(table.number(row, table.find_column("covered_share")), 0.05);
    }
}

TEST(Render, GivesTheSameBytesAgainAndForAPartOfTheFrames) {
    const test::TempFolder folder;
    write_run(folder / "run");
    const std::string run = (folder / "run").string();
    const auto third = [&](const char* name) {
        return read_file(folder / name / "frame.0003.png");
    };

    ASSERT_EQ(render({run, "-o", (folder / "one").string()}), 0);
    ASSERT_EQ(render({run, "-o", (folder / "two").string(), "-j", "1"}), 0);
    ASSERT_EQ(render({run, "-o", (folder / "part").string(), "-f", "3"}), 0);

    EXPECT_EQ(third("one"), third("two"));
    EXPECT_EQ(third("one"), third("part"));
    EXPECT_FALSE(std::filesystem::exists(folder / "part" / "frame.0001.png"));
}

TEST(Render, EachOptionChangesThePicture) {
    const test::TempFolder folder;
    write_run(folder / "run");
    const std::vector<std::vector<std::string>> variations{
        {},
        {"--map", "seed"},
        {"--quantity", "speed"},
        {"--range", "0.95", "1.05"},
        {"--size", "200", "100"},
        {"--no-legend"},
        {"--camera", "1", "1", "2", "0", "0", "0"},
        {"-s", "render.map=viridis"}};
    std::set<std::string> pictures;
    for (const std::vector<std::string>& variation : variations) {
        const std::filesystem::path out = folder / std::to_string(pictures.size());
        std::vector<std::string> arguments{(folder / "run").string(), "-f", "1", "-o",
                                           out.string()};
        arguments.insert(arguments.end(), variation.begin(), variation.end());

        ASSERT_EQ(render(arguments), 0);

        pictures.insert(read_file(out / "frame.0001.png"));
    }
    EXPECT_EQ(pictures.size(), variations.size());
}

TEST(Render, RefusesWhatCannotBeDrawn) {
    const test::TempFolder folder;
    write_run(folder / "run");
    const std::string run = (folder / "run").string();
    const std::string out = (folder / "out").string();

    EXPECT_EQ(render({(folder / "nothing").string()}), 5);
    EXPECT_EQ(render({run, "-f", "1-2"}), 2);
    EXPECT_EQ(render({run, "-o", out, "-f", "4"}), 2);
    EXPECT_EQ(render({run, "-o", out, "-s", "scene.fps=10"}), 2);
    EXPECT_EQ(render({run, "-o", out, "--map", "jet"}), 3);
    EXPECT_EQ(render({run, "-o", out, "--quantity", "heat"}), 3);
    EXPECT_FALSE(std::filesystem::exists(folder / "out" / "frame.0001.png"));
}

} // namespace
} // namespace weft
