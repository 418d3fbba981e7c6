#include "app/commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace weft {
namespace {

struct Outcome {
    int code;
    std::string out;
    std::string err;
};

Outcome run(std::vector<const char*> argv) {
    argv.insert(argv.begin(), "weft");
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = run_command_line(static_cast<int>(argv.size()), argv.data());
    std::fflush(stdout);
    return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

TEST(CommandLine, HelpAndVersionGoToStdoutAndSucceed) {
    for (const char* option : {"--help", "--version"}) {
        const Outcome outcome = run({option});

        EXPECT_EQ(outcome.code, 0) << option;
        EXPECT_NE(outcome.out, "") << option;
        EXPECT_EQ(outcome.err, "") << option;
    }
}

TEST(CommandLine, AMisspeltVerbIsNamedWithTheNearest) {
    const Outcome outcome = run({"fabrik", "list"});

    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "weft: error: fabrik: must be a command; the nearest is fabric; see "
                           "weft --help\n");
}

TEST(CommandLine, WhatItDoesNotUnderstandIsOneLineOnStderrAndCode2) {
    const std::vector<std::vector<const char*>> lines{{},
                                                      {"--nonsense"},
                                                      {"fabric"},
                                                      {"fabric", "show"},
                                                      {"fabric", "list", "more"},
                                                      {"fabric", "list", "--more"}};
    for (const auto& line : lines) {
        const Outcome outcome = run(line);

        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("weft: error: ")) << outcome.err;
    }
}

} // namespace
} // namespace weft
