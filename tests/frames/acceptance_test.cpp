#include "base/error.h"
#include "frames/acceptance.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Acceptance, NamesTheFirstFrameThatBreaksEachRule) {
    const CsvTable table =
        parse_csv("frame,unresolved,stretch_max\n1,0,1.1\n2,0,1.3\n3,1,1.4\n", "stats.csv");
    const std::vector<Rule> rules{parse_rule("penetration"), parse_rule("stretch_max>1.2"),
                                  parse_rule("stretch_max>1.5")};

    const auto lines = broken_rules(rules, table);

    EXPECT_EQ(lines, (std::vector<std::string>{
                         "frame 3: unresolved = 1: fails --fail-on penetration",
                         "frame 2: stretch_max = 1.3: fails --fail-on stretch_max>1.2"}));
}

TEST(Acceptance, RefusesAColumnThatStatisticsDoNotHave) {
    EXPECT_NO_THROW(check_rules(std::vector{parse_rule("stretch_p95>1.2")}));
    try {
        check_rules(std::vector{parse_rule("strech_p95>1.2")});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::CommandLine);
        EXPECT_NE(std::string(error.what()).find("'stretch_p95'"), std::string::npos);
    }
}

} // namespace
} // namespace weft
