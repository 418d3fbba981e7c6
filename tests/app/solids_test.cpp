#include "base/atomic_file.h"
#include "frames/csv.h"
#include "frames/run_folder.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

/// An adaptive napkin falls over a soft cube on a floor, and a rigid ball onto both.
constexpr const char* k_pile = R"(
[scene]
frames = 10
fps = 25
[[cloth]]
name = "napkin"
grid = { size = [0.3, 0.3], cells = [6, 6] }
translate = [0.0, 0.11, 0.0]
rotate_deg = [5.0, 0.0, 0.0]
[cloth.adapt]
levels = 1
[[solid]]
name = "cube"
box = [0.08, 0.08, 0.08]
spacing = 0.02
translate = [0.0, 0.042, 0.0]
[solid.spring]
K = 50.0
K1 = 300.0
K2 = 100.0
mass = 0.1
[[rigid]]
name = "ball"
shape = "box"
size = [0.04, 0.04, 0.04]
translate = [0.0, 0.2, 0.0]
mass = 0.05
[[obstacle]]
name = "floor"
shape = "box"
size = [1.0, 0.1, 1.0]
translate = [0.0, -0.05, 0.0]
[render]
size = [160, 90]
supersample = 1
)";

class Solids : public testing::Test {
protected:
    Solids() { test::write_file(scene, k_pile); }
    test::ProcessResult run(const std::filesystem::path& out, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"simulate", scene.string(), "-o", out.string()});
        return test::run_weft(more, folder.path());
    }

    test::TempFolder folder;
    std::filesystem::path scene = folder / "pile.toml";
    std::filesystem::path out = folder / "out";
};

TEST_F(Solids, PileUpWithClothAndRigidBodiesWithoutCrossing) {
    const test::ProcessResult result =
        run(out, {"-s", "render.enabled=false", "--verify", "--fail-on", "penetration"});
    ASSERT_EQ(result.exit_code, 0) << result.err;

    const CsvTable table = parse_csv(read_file(RunPaths{out}.stats()), "stats.csv");
    const auto value = [&](std::size_t row, const char* name) {
        return table.number(row, table.find_column(name));
    };
    EXPECT_NEAR(value(0, "volume_m3"), 0.08 * 0.08 * 0.08, 1e-12);
    EXPECT_LT(value(9, "volume_m3"), 0.08 * 0.08 * 0.08); // under the weight
    EXPECT_GT(value(9, "volume_m3"), 0.9 * 0.08 * 0.08 * 0.08);
    EXPECT_EQ(value(9, "inverted_cells"), 0.0);
    EXPECT_EQ(value(9, "unresolved"), 0.0);
    EXPECT_GT(value(9, "contacts_self"), 0.0); // of what moves with one another
}

TEST_F(Solids, ResumedRunsAndOtherThreadCountsGiveTheSameBytes) {
    ASSERT_EQ(run(out, {"-j", "1", "-s", "render.enabled=false"}).exit_code, 0);
    const std::filesystem::path stopped = folder / "stopped";
    ASSERT_EQ(
        run(stopped, {"-j", "2", "-s", "render.enabled=false", "-s", "scene.frames=6"}).exit_code,
        0);

    ASSERT_EQ(run(stopped, {"-j", "2", "-s", "render.enabled=false", "--resume"}).exit_code, 0);

    const RunPaths a{out};
    const RunPaths b{stopped};
    EXPECT_TRUE(read_file(a.stats()) == read_file(b.stats()));
    for (const char* name : {"napkin", "cube", "ball"}) {
        EXPECT_TRUE(read_file(a.shape(name, 10)) == read_file(b.shape(name, 10))) << name;
        EXPECT_FALSE(read_file(a.shape(name, 10)) == read_file(a.shape(name, 9))) << name;
    }
}

TEST_F(Solids, AreDrawnAgainFromTheCacheAlone) {
    ASSERT_EQ(run(out, {"-s", "scene.frames=4"}).exit_code, 0);
    const std::string picture = read_file(RunPaths{out}.picture(4));

    const test::ProcessResult again =
        test::run_weft({"render", out.string(), "-o", (folder / "again").string()}, folder.path());

    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(read_file(folder / "again" / "frame.0004.png") == picture);
}

TEST_F(Solids, InspectTellsWhatFillsThem) {
    const test::ProcessResult result = test::run_weft({"inspect", scene.string()}, folder.path());

    EXPECT_EQ(result.exit_code, 0);
    // 5^3 particles, 4^3 cells; 3 * 4 * 25 + 3 * 2 * 16 * 5 + 4 * 64 edges.
    EXPECT_NE(result.out.find("cube: 125 particles, 64 cells, 1036 edges, 0.512 litres, 0.1 kg"),
              std::string::npos)
        << result.out;
}

} // namespace
} // namespace weft
