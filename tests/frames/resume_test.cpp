#include "base/atomic_file.h"
#include "frames/resume.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

class CheckpointFolder : public testing::Test {
protected:
    CheckpointFolder() { std::filesystem::create_directories(paths.checkpoints_dir()); }

    void save(int frame) {
        save_checkpoint(paths, {.frame = frame,
                                .time = 0.04 * frame,
                                .positions = {Vec3(frame, 0, 0)},
                                .velocities = {Vec3::Zero()},
                                .previous_positions = {Vec3::Zero()},
                                .previous_velocities = {Vec3::Zero()}});
    }
    std::vector<int> kept() const {
        std::vector<int> frames;
        for (int frame = 1; frame <= 60; ++frame) {
            if (std::filesystem::exists(paths.checkpoint(frame))) {
                frames.push_back(frame);
            }
        }
        return frames;
    }
    std::optional<Checkpoint> newest() {
        return newest_checkpoint(paths, [&](const std::string& line) { warnings.push_back(line); });
    }

    test::TempFolder folder;
    RunPaths paths{folder.path()};
    std::vector<std::string> warnings;
};

TEST_F(CheckpointFolder, KeepsTheNewestTwo) {
    for (const int frame : {10, 20, 30}) {
        save(frame);
    }

    EXPECT_EQ(kept(), (std::vector<int>{20, 30}));
    EXPECT_EQ(newest()->frame, 30);
}

TEST_F(CheckpointFolder, EndsTheSameWhereverARunWasStopped) {
    for (const int frame : {10, 13, 17, 20, 24, 25}) { // stopped at 13, 17 and 24
        save(frame);
    }

    EXPECT_EQ(kept(), (std::vector<int>{20, 25})); // as 10, 20, 25
}

TEST_F(CheckpointFolder, FallsBackBehindADamagedOne) {
    save(10);
    save(20);
    std::string bytes = read_file(paths.checkpoint(20));
    bytes[bytes.size() / 2] ^= 1;
    write_atomically(paths.checkpoint(20), bytes);

    EXPECT_EQ(newest()->frame, 10);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0], paths.checkpoint(20).string() + ": its checksum does not match: taking "
                                                           "the checkpoint before it");

    drop_checkpoints_after(paths, 10);
    EXPECT_EQ(kept(), (std::vector<int>{10}));
}

TEST_F(CheckpointFolder, WithoutAnyGivesNone) {
    EXPECT_FALSE(newest().has_value());

    write_atomically(paths.failed_checkpoint(), encode_checkpoint({}));
    EXPECT_FALSE(newest().has_value());
}

} // namespace
} // namespace weft
