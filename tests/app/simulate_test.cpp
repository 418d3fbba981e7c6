#include "base/atomic_file.h"
#include "frames/csv.h"
#include "frames/run_folder.h"
#include "support/paths.h"
#include "support/process.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <thread>

namespace weft {
namespace {

namespace fs = std::filesystem;

/// A napkin that falls on a block: 24 frames, contact from the fifth on, no pictures.
constexpr const char* k_napkin = R"(
[scene]
frames = 24
fps = 25
[[cloth]]
name = "napkin"
grid = { size = [0.3, 0.3], cells = [8, 8] }
translate = [0.0, 0.12, 0.0]
model = "corotational"
[[obstacle]]
name = "block"
shape = "box"
size = [0.08, 0.08, 0.08]
motion = [{ t = 0.0 }, { t = 1.0, translate = [0.02, 0.0, 0.0] }]
[render]
size = [160, 90]
supersample = 1
)";

/// Every file that must be the same bytes, however a run came to its end.
std::map<std::string, std::string> lasting_files(const fs::path& run) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(run)) {
        const std::string name = fs::relative(entry.path(), run).generic_string();
        const bool differs = name == "log.txt" || name == "status.json" || name == "timing.csv";
        if (entry.is_regular_file() && !differs) {
            files[name] = read_file(entry.path());
        }
    }
    return files;
}

void expect_same_run(const fs::path& a, const fs::path& b) {
    const auto files_a = lasting_files(a);
    const auto files_b = lasting_files(b);
    ASSERT_GT(files_a.size(), 20U);
    for (const auto& [name, bytes] : files_a) {
        ASSERT_TRUE(files_b.contains(name)) << name << " is missing in " << b;
        EXPECT_TRUE(files_b.at(name) == bytes) << name << " differs in " << b;
    }
    EXPECT_EQ(files_a.size(), files_b.size());
}

class Simulate : public testing::Test {
protected:
    Simulate() { test::write_file(scene, std::string(k_napkin) + "enabled = false\n"); }

    test::ProcessResult run(const fs::path& out, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"simulate", scene.string(), "-o", out.string()});
        return test::run_weft(more, folder.path());
    }
    /// Starts a run and sends it a signal when frame `frame` is in the cache.
    test::ProcessResult interrupt(const fs::path& out, int frame, int signal) {
        test::Process process(test::weft_binary(), {"simulate", scene.string(), "-o", out.string()},
                              folder.path());
        while (process.is_running() && !fs::exists(RunPaths{out}.shape("napkin", frame))) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        process.send(signal);
        return process.wait();
    }
    fs::path straight() {
        const fs::path out = folder / "straight";
        EXPECT_EQ(run(out).exit_code, 0);
        return out;
    }

    test::TempFolder folder;
    fs::path scene = folder / "napkin.toml";
};

TEST_F(Simulate, WritesAllThatTheDocumentationNames) {
    const RunPaths paths{folder / "out"};

    const test::ProcessResult result =
        run(paths.folder, {"-s", "render.enabled=true", "-s", "scene.frames=3"});

    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    for (const fs::path& file :
         {paths.scene(), paths.stats(), paths.timing(), paths.images(), paths.status(), paths.log(),
          paths.picture(1), paths.picture(3), paths.shape("napkin", 1), paths.shape("napkin", 3),
          paths.obstacle("block"), paths.checkpoint(3)}) {
        EXPECT_TRUE(fs::exists(file)) << file;
    }
    EXPECT_EQ(parse_csv(read_file(paths.stats()), "stats.csv").rows.size(), 3U);
    EXPECT_EQ(parse_csv(read_file(paths.images()), "images.csv").rows.size(), 3U);
    const RunStatus status = read_status(paths.status());
    EXPECT_EQ(status.state, RunState::Done);
    EXPECT_EQ(status.frame, 3);
}

TEST_F(Simulate, GivesTheSameBytesForAnyThreadCount) {
    const fs::path one = folder / "one";
    const fs::path two = folder / "two";

    ASSERT_EQ(run(one, {"-j1"}).exit_code, 0);
    ASSERT_EQ(run(two, {"-j2"}).exit_code, 0);

    expect_same_run(one, two);
}

TEST_F(Simulate, ResumedAfterAKillEndsAsTheStraightRun) {
    const fs::path reference = straight();

    for (const int frame : {1, 4, 13, 22}) {
        const fs::path out = folder / ("killed" + std::to_string(frame));
        EXPECT_EQ(interrupt(out, frame, SIGKILL).exit_code, 128 + SIGKILL);
        EXPECT_EQ(run(out, {"--resume"}).exit_code, 0);
        expect_same_run(reference, out);
    }
}

TEST_F(Simulate, ResumedAfterACuredStartEndsAsTheStraightRun) {
    std::string text = k_napkin; // 5 mm below the top of the block, which holds its middle
    text.replace(text.find("0.12, 0.0]"), 10, "0.035, 0.0]");
    text.replace(
        text.find("model ="), 7,
        "pin = [{ box = { min = [-0.03, 0, -0.03], max = [0.03, 1, 0.03] }, to = 'block' }]"
        "\nmodel =");
    for (const std::string way : {"untangle", "grow"}) {
        test::write_file(scene,
                         "[contact]\nstart_overlap = '" + way + "'" + text + "enabled = false\n");
        const fs::path reference = folder / (way + "_straight");
        const test::ProcessResult result = run(reference);
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_NE(result.err.find("pairs of triangles crossed, now none"), std::string::npos)
            << result.err;

        const fs::path out = folder / (way + "_killed");
        EXPECT_EQ(interrupt(out, 13, SIGKILL).exit_code, 128 + SIGKILL);
        EXPECT_EQ(run(out, {"--resume", "-j", "3"}).exit_code, 0);

        expect_same_run(reference, out);
    }
}

TEST_F(Simulate, KilledAgainAndAgainStillEndsAsTheStraightRun) {
    const fs::path reference = straight();
    const fs::path out = folder / "out";

    for (int delay_ms = 1; delay_ms < 200; delay_ms += 13) { // also before the folder is ready
        test::Process process(test::weft_binary(),
                              {"simulate", scene.string(), "-o", out.string(), "--resume"},
                              folder.path());
        std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
        process.send(SIGKILL);
        process.wait();
    }
    EXPECT_EQ(run(out, {"--resume"}).exit_code, 0);

    expect_same_run(reference, out);
}

TEST_F(Simulate, StoppedBySignalsLeavesACheckpointAndTheCode75) {
    const fs::path reference = straight();

    for (const int signal : {SIGINT, SIGTERM}) {
        const fs::path out = folder / ("stopped" + std::to_string(signal));
        const test::ProcessResult stopped = interrupt(out, 7, signal);

        EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
        const RunStatus status = read_status(RunPaths{out}.status());
        EXPECT_EQ(status.state, RunState::Stopped);
        EXPECT_EQ(status.exit_code, 75);
        EXPECT_TRUE(fs::exists(RunPaths{out}.checkpoint(status.frame)));
        EXPECT_EQ(run(out, {"--resume"}).exit_code, 0);
        expect_same_run(reference, out);
    }
}

TEST_F(Simulate, PicturesOfAStoppedRunAreThoseOfTheStraightOneAndOfRender) {
    test::write_file(scene, std::string(k_napkin) + "enabled = true\n");
    const fs::path reference = straight();
    const fs::path again = folder / "again";

    for (const int signal : {SIGKILL, SIGTERM}) {
        const fs::path out = folder / ("stopped" + std::to_string(signal));
        interrupt(out, 13, signal);
        EXPECT_TRUE(fs::exists(RunPaths{out}.picture(12))); // drawn while the run went on
        EXPECT_EQ(run(out, {"--resume"}).exit_code, 0);
        expect_same_run(reference, out);
    }
    ASSERT_EQ(test::run_weft({"render", reference.string(), "-o", again.string()}, folder.path())
                  .exit_code,
              0);
    for (int frame = 1; frame <= 24; ++frame) {
        const fs::path picture = RunPaths{reference}.picture(frame);
        EXPECT_TRUE(read_file(picture) == read_file(again / picture.filename())) << frame;
    }
}

TEST_F(Simulate, DrawsPicturesOfAResumedRunAsItsSceneNowSays) {
    const fs::path out = folder / "out";
    ASSERT_EQ(run(out, {"-s", "render.enabled=true", "-s", "scene.frames=12"}).exit_code, 0);

    ASSERT_EQ(
        run(out, {"--resume", "-s", "render.enabled=true", "-s", "render.map='seed'"}).exit_code,
        0);

    const fs::path reference = folder / "reference";
    ASSERT_EQ(run(reference, {"-s", "render.enabled=true", "-s", "render.map='seed'"}).exit_code,
              0);
    expect_same_run(reference, out);
}

TEST_F(Simulate, ShowsClothThatGoesWhereNobodyForesaw) {
    // The block is pulled away from under the napkin that lands on it, which falls on.
    const std::vector<std::string> pulled{
        "-s", "render.enabled=true",
        "-s", "scene.air_density=0",
        "-s", "obstacle[0].motion=[{ t = 0.0 }, { t = 0.5, translate = [0.0, 0.0, -0.6] }]",
        "-s", "scene.frames=14",
        "-s", "render.size=[320, 180]"};
    const fs::path out = folder / "out";

    const test::ProcessResult result = run(out, pulled);

    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("not as foreseen"), std::string::npos) << result.err;
    const CsvTable table = parse_csv(read_file(RunPaths{out}.images()), "images.csv");
    ASSERT_EQ(table.rows.size(), 14U);
    for (std::size_t row = 8; row < 14; ++row) { // before that the block may hide the napkin
        EXPECT_GT(table.number(row, table.find_column("covered_share")), 0.0) << row + 1;
    }
    const fs::path again = folder / "again";
    ASSERT_EQ(
        test::run_weft({"render", out.string(), "-o", again.string()}, folder.path()).exit_code, 0);
    EXPECT_TRUE(read_file(RunPaths{out}.picture(14)) == read_file(again / "frame.0014.png"));
}

TEST_F(Simulate, LeavesThePicturesOfAnUnfinishedRunToItself) {
    const fs::path out = folder / "out";
    ASSERT_EQ(interrupt(out, 7, SIGTERM).exit_code, 75);

    EXPECT_EQ(test::run_weft({"render", out.string()}, folder.path()).exit_code, 2);
    EXPECT_EQ(
        test::run_weft({"render", out.string(), "-o", (folder / "so far").string()}, folder.path())
            .exit_code,
        0);
}

TEST_F(Simulate, StopsAtTheTimeLimit) {
    const fs::path out = folder / "out";

    EXPECT_EQ(run(out, {"--time-limit", "1e-6"}).exit_code, 75);
    EXPECT_EQ(run(out, {"--resume"}).exit_code, 0);

    expect_same_run(straight(), out);
}

TEST_F(Simulate, FallsBackBehindADamagedCheckpoint) {
    const fs::path reference = straight();
    const fs::path out = folder / "out";
    fs::copy(reference, out, fs::copy_options::recursive);
    test::write_file(RunPaths{out}.checkpoint(24), "half a file");

    const test::ProcessResult result = run(out, {"--resume"});

    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.err.find("0024.weft: truncated"), std::string::npos) << result.err;
    expect_same_run(reference, out);
}

TEST_F(Simulate, ResumedWithMoreFramesEndsAsTheLongRun) {
    const fs::path out = folder / "out";

    ASSERT_EQ(run(out, {"-s", "scene.frames=15"}).exit_code, 0);
    ASSERT_EQ(run(out, {"--resume"}).exit_code, 0);

    expect_same_run(straight(), out);
}

TEST_F(Simulate, ResumesARunThatTheVersionBeforeWrote) {
    const fs::path out = folder / "out";
    ASSERT_EQ(run(out, {"-s", "scene.frames=15"}).exit_code, 0);
    std::string stats = read_file(RunPaths{out}.stats());
    stats.replace(stats.find("adaptation_J"), std::strlen("adaptation_J"), "adaption_J");
    test::write_file(RunPaths{out}.stats(), stats);

    const test::ProcessResult result = run(out, {"--resume"});

    ASSERT_EQ(result.exit_code, 0) << result.err;
    expect_same_run(straight(), out);
}

TEST_F(Simulate, UnderstandsTheOldNameOfAColumnInARule) {
    const test::ProcessResult result =
        run(folder / "out", {"-s", "scene.frames=2", "--fail-on", "adaption_J<1"});

    EXPECT_EQ(result.exit_code, 6) << result.err;
    EXPECT_NE(result.err.find("is now named 'adaptation_J'"), std::string::npos) << result.err;
}

TEST_F(Simulate, HasNothingToDoForAFinishedRun) {
    const fs::path out = straight();
    const auto written = fs::last_write_time(RunPaths{out}.stats());

    const test::ProcessResult result = run(out, {"--resume"});

    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.err.find("nothing is left to do"), std::string::npos) << result.err;
    EXPECT_EQ(fs::last_write_time(RunPaths{out}.stats()), written);
}

TEST_F(Simulate, RefusesToResumeAnotherScene) {
    const fs::path out = straight();

    const test::ProcessResult result = run(out, {"--resume", "-s", "scene.fps=50"});

    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("fps = 25"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("fps = 50"), std::string::npos) << result.err;
}

TEST_F(Simulate, RefusesAFolderThatIsNotEmpty) {
    const fs::path out = straight();

    EXPECT_EQ(run(out).exit_code, 2);
    EXPECT_EQ(run(folder.path(), {"--overwrite"}).exit_code, 2); // holds the scene, no run
    EXPECT_TRUE(fs::exists(scene));
    EXPECT_EQ(run(out, {"--overwrite", "-s", "scene.frames=2"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(RunPaths{out}.shape("napkin", 3)));
}

TEST_F(Simulate, WritesOnlyTheFramesAskedForButAllStatistics) {
    const RunPaths paths{folder / "out"};

    ASSERT_EQ(run(paths.folder, {"-f", "5-11x3"}).exit_code, 0);

    for (int frame = 1; frame <= 24; ++frame) {
        const bool wanted = frame == 5 || frame == 8 || frame == 11;
        EXPECT_EQ(fs::exists(paths.shape("napkin", frame)), wanted) << frame;
    }
    EXPECT_EQ(parse_csv(read_file(paths.stats()), "stats.csv").rows.size(), 24U);
}

TEST_F(Simulate, FailsOnABrokenRuleNamingFrameAndValue) {
    const fs::path out = folder / "out";

    const test::ProcessResult result = run(out, {"--fail-on", "com_y_m<0.1"});

    EXPECT_EQ(result.exit_code, 6);
    EXPECT_NE(result.err.find("com_y_m = 0.0"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("frame "), std::string::npos) << result.err;
    EXPECT_EQ(run(folder / "b", {"--fail-on", "penetration"}).exit_code, 0);
    EXPECT_EQ(run(folder / "c", {"--fail-on", "com_z>1"}).exit_code, 2);
}

TEST_F(Simulate, RefusesClothThatCrossesAnObstacleAtTheStart) {
    const test::ProcessResult result =
        run(folder / "out", {"-s", "cloth[0].translate=[0.0, 0.01, 0.0]"});

    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find("pairs cross at the start"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Simulate, WarnsOfAMeshFinerThanItsContactThickness) {
    const test::ProcessResult fine =
        run(folder / "out", {"--dry-run", "-s", "cloth[0].fabric.thickness=0.1"});
    const test::ProcessResult coarse = run(folder / "out", {"--dry-run"});

    EXPECT_EQ(fine.exit_code, 0) << fine.err;
    EXPECT_NE(fine.err.find("napkin: contact thickness 0.1 m is coarse"), std::string::npos)
        << fine.err;
    EXPECT_EQ(coarse.err.find("is coarse"), std::string::npos) << coarse.err;
}

TEST_F(Simulate, DryRunWritesNothing) {
    const test::ProcessResult result = run(folder / "out", {"--dry-run"});

    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.out.find("cloth 'napkin': 81 vertices, 128 triangles"), std::string::npos)
        << result.out;
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Simulate, SaysInOneLineThatTheFolderCannotBeMade) {
    const test::ProcessResult result = run("/dev/null/out");

    EXPECT_EQ(result.exit_code, 5);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
}

TEST_F(Simulate, SaysThatTheDiskIsFull) {
    // A checkpoint folder that cannot take the file stands for a full disk: writes fail midway.
    const fs::path out = folder / "out";
    ASSERT_EQ(run(out, {"-s", "scene.frames=5"}).exit_code, 0);
    fs::create_directory(RunPaths{out}.checkpoint(10).string() + ".part");

    const test::ProcessResult result = run(out, {"--resume", "-q"});

    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_NE(result.err.find("0010.weft: cannot write"), std::string::npos) << result.err;
    const RunStatus status = read_status(RunPaths{out}.status());
    EXPECT_EQ(status.state, RunState::Failed);
    EXPECT_EQ(status.frame, 9); // the last that is whole on the disk
}

} // namespace
} // namespace weft
