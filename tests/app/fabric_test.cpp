#include "app/commands.h"
#include "scene/fabric.h"

#include <gtest/gtest.h>

#include <vector>

namespace weft {
namespace {

struct Outcome {
    int code;
    std::string out;
    std::string err;
};

Outcome run(const std::vector<const char*>& arguments) {
    std::vector<const char*> argv{"weft"};
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_command_line(static_cast<int>(argv.size()), argv.data());
    std::fflush(stdout);
    return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(FabricCommand, ListsEachPresetInALine) {
    const Outcome outcome = run({"fabric", "list"});

    EXPECT_EQ(outcome.code, 0);
    for (const Fabric& fabric : fabric_library()) {
        EXPECT_NE(outcome.out.find("\n" + fabric.name + " "), std::string::npos);
        EXPECT_NE(outcome.out.find(fabric.description + "\n"), std::string::npos);
    }
}

TEST(FabricCommand, ShowsThePresetAsItsFileStands) {
    const Outcome outcome = run({"fabric", "show", "denim"});

    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out, find_fabric("denim")->toml);
}

TEST(FabricCommand, NamesTheNearestPreset) {
    const Outcome outcome = run({"fabric", "show", "denm"});

    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(
        outcome.err,
        "weft: error: fabric denm: must be a name of weft fabric list; the nearest is denim\n");
}

} // namespace
} // namespace weft
