#include "base/atomic_file.h"
#include "frames/csv.h"
#include "frames/run_folder.h"
#include "support/paths.h"
#include "support/process.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <set>

namespace weft {
namespace {

namespace fs = std::filesystem;

fs::path scene_file(const std::string& name) {
    return test::source_path("assets/scenes/contact/" + name + ".toml");
}

/// Without pictures and with every substep verified.
test::ProcessResult simulate(const std::string& name, const fs::path& out, int frames) {
    return test::run_weft({"simulate", scene_file(name).string(), "-o", out.string(), "--verify",
                           "-s", "render.enabled=false", "-s",
                           "scene.frames=" + std::to_string(frames)},
                          out.parent_path());
}

TEST(ContactScenes, AllStartApart) {
    const test::TempFolder folder;
    int count = 0;
    for (const auto& entry : fs::directory_iterator(test::source_path("assets/scenes/contact"))) {
        const auto result =
            test::run_weft({"simulate", entry.path().string(), "-n"}, folder.path());
        EXPECT_EQ(result.exit_code, 0) << result.err;
        ++count;
    }
    EXPECT_GE(count, 10);
}

TEST(ContactScenes, SheetOverASphereCrossesNothingInAnySubstep) {
    const test::TempFolder folder;
    const RunPaths run{folder / "out"};

    const auto result = simulate("sphere_32", run.folder, 30);

    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(parse_csv(read_file(run.problems()), "problems.csv").rows.empty());
    const CsvTable stats = parse_csv(read_file(run.stats()), "stats.csv");
    EXPECT_GT(stats.number(29, stats.find_column("contacts_obstacle")), 0.0); // it lies by then
}

TEST(ContactScenes, ClothWithoutRoomIsToldOfAndComesFreeWhenThereIs) {
    const test::TempFolder folder;
    const RunPaths run{folder / "out"};

    const auto result = simulate("pinched_by_boxes", run.folder, 48);

    ASSERT_EQ(result.exit_code, 0) << result.err; // none of its steps failed for good
    const CsvTable problems = parse_csv(read_file(run.problems()), "problems.csv");
    const CsvTable stats = parse_csv(read_file(run.stats()), "stats.csv");
    std::set<int> told;
    for (std::size_t row = 0; row < problems.rows.size(); ++row) {
        told.insert(static_cast<int>(problems.number(row, 0)));
    }
    for (int frame = 1; frame <= 48; ++frame) {
        const auto row = static_cast<std::size_t>(frame - 1);
        const bool unresolved = stats.number(row, stats.find_column("unresolved")) > 0.0;
        EXPECT_EQ(unresolved, told.contains(frame)) << frame;
        EXPECT_LT(stats.number(row, stats.find_column("max_speed_m_s")), 10.0) << frame;
        if (frame <= 24) { // the boxes are still 1 cm apart
            EXPECT_FALSE(unresolved) << frame;
        } else if (frame >= 27 && frame <= 33) { // they overlap, from 1.0 s to 1.3 s
            EXPECT_TRUE(unresolved) << frame;
        } else if (frame >= 38) { // they have opened by 5 cm
            EXPECT_FALSE(unresolved) << frame;
        }
    }
}

} // namespace
} // namespace weft
