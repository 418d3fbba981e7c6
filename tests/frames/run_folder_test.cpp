#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/run_folder.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
    fs::create_directories(file.parent_path());
    write_atomically(file, std::string_view("x"));
}

/// A folder as an earlier run left it.
void make_old_run(const RunPaths& paths) {
    for (const fs::path& file :
         {paths.scene(), paths.status(), paths.stats(), paths.shape("shirt", 1), paths.picture(1),
          paths.checkpoint(10), fs::path(paths.stats().string() + ".part")}) {
        touch(file);
    }
}

ExitCode code_of(const fs::path& folder, FolderMode mode) {
    try {
        check_run_folder(folder, mode);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::Done;
}

TEST(RunFolder, IsMadeWithItsParts) {
    const test::TempFolder temp;

    const RunFolder run(temp / "a/b", FolderMode::Fresh);

    EXPECT_TRUE(fs::is_directory(run.paths().cache_dir()));
    EXPECT_TRUE(fs::is_directory(run.paths().checkpoints_dir()));
}

TEST(RunFolder, ThatIsNotEmptyIsRefusedWithoutAMode) {
    const test::TempFolder temp;
    make_old_run({temp.path()});

    EXPECT_EQ(code_of(temp.path(), FolderMode::Fresh), ExitCode::CommandLine);
    EXPECT_EQ(code_of(temp.path(), FolderMode::Resume), ExitCode::Done);
    EXPECT_EQ(code_of(temp.path(), FolderMode::Overwrite), ExitCode::Done);
}

TEST(RunFolder, OfAStrangerIsRefusedInEveryMode) {
    const test::TempFolder temp;
    touch(temp / "thesis.tex");

    for (const auto mode : {FolderMode::Fresh, FolderMode::Resume, FolderMode::Overwrite}) {
        EXPECT_EQ(code_of(temp.path(), mode), ExitCode::CommandLine);
    }
    EXPECT_EQ(code_of(temp / "thesis.tex", FolderMode::Fresh), ExitCode::CommandLine);
    EXPECT_TRUE(fs::exists(temp / "thesis.tex"));
}

TEST(RunFolder, OfARunKilledBeforeItsSceneWasWrittenCountsAsEmpty) {
    const test::TempFolder temp;
    { const RunFolder run(temp.path(), FolderMode::Fresh); }
    touch(temp / "scene.resolved.toml.part");

    for (const auto mode : {FolderMode::Fresh, FolderMode::Resume, FolderMode::Overwrite}) {
        EXPECT_EQ(code_of(temp.path(), mode), ExitCode::Done);
    }
}

TEST(RunFolder, OverwritesOnlyWhatARunWrites) {
    const test::TempFolder temp;
    const RunPaths paths{temp.path()};
    make_old_run(paths);
    touch(temp / "notes.txt");
    touch(temp / "frames/best.png");

    const RunFolder run(temp.path(), FolderMode::Overwrite);

    EXPECT_TRUE(fs::exists(temp / "notes.txt"));
    EXPECT_TRUE(fs::exists(temp / "frames/best.png"));
    for (const fs::path& file : {paths.scene(), paths.status(), paths.stats(),
                                 paths.shape("shirt", 1), paths.picture(1), paths.checkpoint(10)}) {
        EXPECT_FALSE(fs::exists(file)) << file;
    }
}

TEST(RunFolder, ResumedLosesOnlyHalfWrittenFiles) {
    const test::TempFolder temp;
    const RunPaths paths{temp.path()};
    make_old_run(paths);

    const RunFolder run(temp.path(), FolderMode::Resume);

    EXPECT_FALSE(fs::exists(paths.stats().string() + ".part"));
    EXPECT_TRUE(fs::exists(paths.stats()));
    EXPECT_TRUE(fs::exists(paths.checkpoint(10)));
}

TEST(RunFolder, IsHeldAgainstASecondRun) {
    const test::TempFolder temp;
    const RunFolder first(temp.path(), FolderMode::Fresh);

    EXPECT_THROW(RunFolder(temp.path(), FolderMode::Fresh), Error);
}

TEST(RunFolder, ThatCannotBeMadeIsADiskError) {
    const test::TempFolder temp;
    touch(temp / "file");

    try {
        RunFolder(temp / "file/below", FolderMode::Fresh);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::Disk);
    }
}

} // namespace
} // namespace weft
