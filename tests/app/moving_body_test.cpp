#include "base/atomic_file.h"
#include "frames/ply.h"
#include "frames/run_folder.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace weft {
namespace {

/// A napkin on a block that is squeezed flat and wide, its mesh a sequence of files, with a corner
/// pinned to it.
constexpr const char* k_squeezed = R"(
[scene]
frames = 10
fps = 25
[[cloth]]
name = "napkin"
grid = { size = [0.3, 0.3], cells = [8, 8] }
translate = [0.0, 0.105, 0.0]
[[cloth.pin]]
vertices = [40]
to = "block"
[[obstacle]]
name = "block"
sequence = "block.##.obj"
sequence_fps = 20.0
motion = [{ t = 0.0 }, { t = 1.0, translate = [0.02, 0.0, 0.0] }]
[render]
size = [160, 90]
supersample = 1
)";

std::string block(double width, double height) {
    const double w = 0.5 * width;
    std::string text;
    for (const double y : {0.0, height}) {
        text +=
            fmt::format("v {0} {1} {0}\nv -{0} {1} {0}\nv -{0} {1} -{0}\nv {0} {1} -{0}\n", w, y);
    }
    return text + "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
}

class MovingBody : public testing::Test {
protected:
    MovingBody() {
        test::write_file(scene, k_squeezed);
        for (int k = 0; k <= 8; ++k) {
            test::write_file(folder / fmt::format("block.{:02}.obj", k + 1),
                             block(0.1 + 0.02 * k, 0.1 - 0.008 * k));
        }
    }
    test::ProcessResult run(const std::filesystem::path& out, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"simulate", scene.string(), "-o", out.string()});
        return test::run_weft(more, folder.path());
    }

    test::TempFolder folder;
    std::filesystem::path scene = folder / "squeezed.toml";
    std::filesystem::path out = folder / "out";
};

TEST_F(MovingBody, CarriesClothAndPinWithoutCrossing) {
    const test::ProcessResult result = run(out, {"--fail-on", "penetration"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string bytes = read_file(RunPaths{out}.shape("napkin", 10));
    const FrameObject napkin = decode_ply(bytes, "napkin");

    // 0.36 s: the top has come down by 7.2 files of 8 mm, and gone aside by 7.2 mm; the pinned
    // middle of the napkin stays 5 mm above it.
    EXPECT_LT((napkin.positions[40] - Vec3f(0.0072F, 0.0474F, 0.0F)).norm(), 1e-5F);
    const std::string first = read_file(RunPaths{out}.shape("block", 1));
    EXPECT_NE(first, read_file(RunPaths{out}.shape("block", 10)));
}

TEST_F(MovingBody, ResumedRunsAndOtherThreadCountsGiveTheSameBytes) {
    ASSERT_EQ(run(out, {"-j", "1", "-s", "render.enabled=false"}).exit_code, 0);
    const std::filesystem::path stopped = folder / "stopped";
    ASSERT_EQ(run(stopped, {"-s", "render.enabled=false", "-s", "scene.frames=4"}).exit_code, 0);

    ASSERT_EQ(run(stopped, {"-s", "render.enabled=false", "--resume"}).exit_code, 0);

    const RunPaths a{out};
    const RunPaths b{stopped};
    EXPECT_EQ(read_file(a.stats()), read_file(b.stats()));
    EXPECT_EQ(read_file(a.shape("block", 10)), read_file(b.shape("block", 10)));
    EXPECT_EQ(read_file(a.shape("napkin", 10)), read_file(b.shape("napkin", 10)));
}

TEST_F(MovingBody, IsDrawnAgainFromTheCacheAlone) {
    ASSERT_EQ(run(out).exit_code, 0);
    for (int k = 1; k <= 9; ++k) {
        std::filesystem::remove(folder / fmt::format("block.{:02}.obj", k));
    }
    const std::string picture = read_file(RunPaths{out}.picture(10));

    const test::ProcessResult again =
        test::run_weft({"render", out.string(), "-o", (folder / "again").string()}, folder.path());

    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(read_file(folder / "again" / "frame.0010.png") == picture);
}

TEST_F(MovingBody, ChangedFilesStopAResume) {
    ASSERT_EQ(run(out, {"-s", "render.enabled=false", "-s", "scene.frames=4"}).exit_code, 0);
    test::write_file(folder / "block.09.obj", block(0.2, 0.1));

    const test::ProcessResult result = run(out, {"-s", "render.enabled=false", "--resume"});

    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("a mesh file has changed since the run began"), std::string::npos);
}

TEST_F(MovingBody, InspectTellsOfItsFiles) {
    const test::ProcessResult result = test::run_weft({"inspect", scene.string()}, folder.path());

    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.out.find("9 files, 20 a second"), std::string::npos) << result.out;

    std::filesystem::remove(folder / "block.05.obj");
    const test::ProcessResult refused = run(out);
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_NE(refused.err.find("number 5 is missing"), std::string::npos) << refused.err;
}

} // namespace
} // namespace weft
