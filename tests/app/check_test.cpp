#include "support/process.h"
#include "support/temp_folder.h"
#include "support/text_file.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

class Check : public testing::Test {
protected:
    Check() {
        test::write_file(folder / "stats.csv", "frame,stretch_max,min_gap_m\n"
                                               "1,1,inf\n2,1.2,0.002\n3,1.4,0.001\n4,1.1,0.003\n");
        test::write_file(folder / "images.csv", "frame,file,covered_share\n1,a.png,0.25\n");
    }
    test::ProcessResult check(const std::string& expectations) {
        test::write_file(folder / "expect.toml", expectations);
        return test::run_weft({"check", folder.path().string(), (folder / "expect.toml").string()},
                              folder.path());
    }
    test::TempFolder folder;
};

TEST_F(Check, CountsWhatHeld) {
    const auto result = check("[[expect]]\ncolumn = 'stretch_max'\nmax = 1.4\n"
                              "[[expect]]\nfile = 'images'\ncolumn = 'covered_share'\n"
                              "equals = 0.24\ntolerance = 0.02\n");

    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "2 of 2 expectations held\n");
}

TEST_F(Check, GivesALineForEachMiss) {
    const auto result = check("[[expect]]\ncolumn = 'stretch_max'\nmax = 1.25\n"
                              "[[expect]]\ncolumn = 'min_gap_m'\nmin = 0.002\nat = 'min'\n"
                              "[[expect]]\ncolumn = 'stretch_max'\nmax = 1.25\nframes = '1-2'\n");

    EXPECT_EQ(result.exit_code, 6);
    EXPECT_NE(result.out.find("frame 3: stretch_max = 1.4: must be <= 1.25"), std::string::npos)
        << result.out;
    EXPECT_NE(result.out.find("min, frame 3: min_gap_m = 0.001: must be >= 0.002"),
              std::string::npos)
        << result.out;
    EXPECT_NE(result.out.find("1 of 3 expectations held\n"), std::string::npos) << result.out;
}

TEST_F(Check, RefusesAnUnknownColumn) {
    const auto result = check("[[expect]]\ncolumn = 'stretch_mx'\nmax = 1.25\n");

    EXPECT_EQ(result.exit_code, 3);
    EXPECT_NE(result.err.find("did you mean 'stretch_max'?"), std::string::npos) << result.err;
}

TEST_F(Check, SaysThatAFolderHasNoStatistics) {
    test::write_file(folder / "expect.toml", "[[expect]]\ncolumn = 'a'\nmax = 1\n");

    const auto result = test::run_weft(
        {"check", (folder / "none").string(), (folder / "expect.toml").string()}, folder.path());

    EXPECT_EQ(result.exit_code, 5);
}

TEST_F(Check, UnderstandsTheOldNameOfAColumnInOldAndNewRuns) {
    for (const char* header : {"frame,adaption_J\n", "frame,adaptation_J\n"}) {
        test::write_file(folder / "stats.csv", header + std::string("1,0.5\n"));
        for (const char* name : {"adaption_J", "adaptation_J"}) {
            const auto result =
                check(std::string("[[expect]]\ncolumn = '") + name + "'\nequals = 0.5\n");

            EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
            EXPECT_EQ(result.err.find("is now named 'adaptation_J'") != std::string::npos,
                      std::string(name) == "adaption_J")
                << result.err;
        }
    }
}

TEST_F(Check, TellsWhatTheColumnsMean) {
    const auto result = test::run_weft({"check", "--columns"}, folder.path());

    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("| `kinetic_J` | J | Kinetic energy |\n"), std::string::npos)
        << result.out;
}

} // namespace
} // namespace weft
