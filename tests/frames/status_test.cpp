#include "base/atomic_file.h"
#include "base/error.h"
#include "frames/run_folder.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Status, ReadsBack) {
    const test::TempFolder folder;
    write_status(folder / "status.json", {.state = RunState::Stopped,
                                          .frame = 30,
                                          .frames = 120,
                                          .seconds_per_frame = 0.5,
                                          .seconds_left = 45.0,
                                          .exit_code = 75,
                                          .message = "stopped \"by\" a signal"});

    const RunStatus status = read_status(folder / "status.json");

    EXPECT_EQ(status.state, RunState::Stopped);
    EXPECT_EQ(status.frame, 30);
    EXPECT_EQ(status.frames, 120);
    EXPECT_EQ(status.seconds_per_frame, 0.5);
    EXPECT_EQ(status.exit_code, 75);
    EXPECT_EQ(status.message, "stopped \"by\" a signal");
    EXPECT_NE(read_file(folder / "status.json").find("\"percent\": 25.0"), std::string::npos);
}

TEST(Status, TakesAMessageThatIsNoUtf8) {
    const test::TempFolder folder;

    write_status(folder / "status.json", {.message = "bad \xff byte"});

    EXPECT_NO_THROW(read_status(folder / "status.json"));
}

TEST(Status, IsRefusedWhenItIsSomethingElse) {
    const test::TempFolder folder;
    write_atomically(folder / "status.json", std::string_view("{}"));

    EXPECT_THROW(read_status(folder / "status.json"), Error);
    EXPECT_THROW(read_status(folder / "none.json"), Error);
}

} // namespace
} // namespace weft
