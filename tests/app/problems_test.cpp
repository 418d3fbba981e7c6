#include "base/atomic_file.h"
#include "frames/csv.h"
#include "frames/problems.h"
#include "frames/run_folder.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

namespace fs = std::filesystem;

/// A napkin on a block, and a press that leaves it no room from 0.3 s to 0.4 s.
constexpr const char* k_press = R"(
[scene]
frames = 14
fps = 25
[[cloth]]
name = "napkin"
grid = { size = [0.3, 0.3], cells = [8, 8] }
translate = [0.0, 0.052, 0.0]
[[obstacle]]
name = "block"
shape = "box"
size = [0.1, 0.1, 0.1]
[[obstacle]]
name = "press"
shape = "box"
size = [0.08, 0.1, 0.08]
translate = [0.0, 0.12, 0.0]
motion = [{ t = 0.1 }, { t = 0.3, translate = [0.0, -0.023, 0.0] }, { t = 0.4, translate = [0.0, -0.023, 0.0] }, { t = 0.45, translate = [0.0, 0.05, 0.0] }]
[render]
enabled = false
size = [320, 180]
supersample = 1
)";

class ProblemsTable : public testing::Test {
protected:
    ProblemsTable() { test::write_file(scene, k_press); }

    test::ProcessResult run(const fs::path& out, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"simulate", scene.string(), "-o", out.string(), "--verify"});
        return test::run_weft(more, folder.path());
    }
    static std::string table_of(const fs::path& out) { return read_file(RunPaths{out}.problems()); }

    test::TempFolder folder;
    fs::path scene = folder / "press.toml";
};

TEST_F(ProblemsTable, IsAHeaderAloneWhereContactWorks) {
    const fs::path out = folder / "out";

    const auto result = run(out, {"-s", "scene.frames=6", "--fail-on", "penetration"});

    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(table_of(out), std::string(problems_header()) + "\n");
}

TEST_F(ProblemsTable, NamesPairsThatHaveNoRoom) {
    const fs::path out = folder / "out";

    const auto result = run(out, {"--fail-on", "penetration"});

    EXPECT_EQ(result.exit_code, 6) << result.err;
    const CsvTable table = parse_csv(table_of(out), "problems.csv");
    const CsvTable stats = parse_csv(read_file(RunPaths{out}.stats()), "stats.csv");
    ASSERT_GT(table.rows.size(), 0U);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const int frame = static_cast<int>(table.number(row, 0));
        EXPECT_GE(frame, 6); // before it the press is far away
        EXPECT_GT(
            stats.number(static_cast<std::size_t>(frame - 1), stats.find_column("unresolved")),
            0.0);
        const auto cell = [&](const char* name) {
            return table.rows[row][static_cast<std::size_t>(table.find_column(name))];
        };
        EXPECT_EQ(cell("object_a"), "napkin");
        EXPECT_TRUE(cell("object_b") == "block" || cell("object_b") == "press" ||
                    cell("object_b") == "napkin");
        EXPECT_LT(std::stoi(cell("triangle_a")), 2 * 8 * 8);
    }
}

TEST_F(ProblemsTable, IsTheSameForAnyThreadCountAndForAResumedRun) {
    const fs::path straight = folder / "straight";
    const fs::path resumed = folder / "resumed";

    ASSERT_EQ(run(straight, {"-j1"}).exit_code, 0);
    ASSERT_EQ(run(resumed, {"-j2", "-s", "scene.frames=10"}).exit_code, 0);
    ASSERT_EQ(run(resumed, {"-j2", "--resume"}).exit_code, 0);

    EXPECT_EQ(table_of(straight), table_of(resumed));
}

TEST_F(ProblemsTable, IsDrawnWhenAskedForLiveAndFromTheCache) {
    const fs::path out = folder / "out";
    ASSERT_EQ(run(out, {"-s", "render.enabled=true", "-s", "render.problems=true"}).exit_code, 0);
    const auto draw = [&](const char* name, const char* problems) {
        EXPECT_EQ(test::run_weft({"render", out.string(), "-o", (folder / name).string(), "-s",
                                  std::string("render.problems=") + problems},
                                 folder.path())
                      .exit_code,
                  0);
        return read_file(folder / name / "frame.0010.png"); // within the pinch
    };

    const std::string marked = draw("marked", "true");

    EXPECT_TRUE(read_file(RunPaths{out}.picture(10)) == marked);
    EXPECT_FALSE(draw("plain", "false") == marked);
}

} // namespace
} // namespace weft
