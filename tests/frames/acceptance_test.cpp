#include "base/error.h"
#include "frames/acceptance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

void never(const std::string& line) {
    ADD_FAILURE() << line;
}

TEST(Rule, TwoWordsStandForTheColumnsThatMustStayZero) {
    EXPECT_EQ(parse_rule("penetration").column, "unresolved");
    EXPECT_FALSE(parse_rule("penetration").is_broken_by(0.0));
    EXPECT_TRUE(parse_rule("penetration").is_broken_by(1.0));
    EXPECT_EQ(parse_rule("retries").column, "retries");
}

TEST(Rule, EachComparisonSaysWhenTheRunFails) {
    EXPECT_EQ(parse_rule("stretch_max>1.3").column, "stretch_max");
    EXPECT_FALSE(parse_rule("stretch_max>1.3").is_broken_by(1.3));
    EXPECT_TRUE(parse_rule("stretch_max>=1.3").is_broken_by(1.3));
    EXPECT_FALSE(parse_rule("min_gap_m < 1e-4").is_broken_by(1e-4));
    EXPECT_TRUE(parse_rule("min_gap_m <= 1e-4").is_broken_by(1e-4));
}

TEST(Rule, WhatIsNotANumberBreaksIt) {
    for (const char* text : {"a<1", "a<=1", "a>1", "a>=1"}) {
        EXPECT_TRUE(parse_rule(text).is_broken_by(std::nan(""))) << text;
    }
}

TEST(Rule, RefusesWhatIsNoRule) {
    for (const char* text : {"", "penetrations", "stretch_max", "stretch_max>", ">1", "a>1x",
                             "a>inf", "a==1", "a b>1", "a>>1"}) {
        try {
            parse_rule(text);
            ADD_FAILURE() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::CommandLine) << text;
        }
    }
}

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
    std::vector known{parse_rule("stretch_p95>1.2")};
    EXPECT_NO_THROW(check_rules(known, never));
    std::vector unknown{parse_rule("strech_p95>1.2")};
    try {
        check_rules(unknown, never);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::CommandLine);
        EXPECT_NE(std::string(error.what()).find("'stretch_p95'"), std::string::npos);
    }
}

TEST(Acceptance, UnderstandsARenamedColumnWithOneWarning) {
    std::vector<std::string> lines;
    const auto warn = [&](const std::string& line) { lines.push_back(line); };
    std::vector rules{parse_rule("adaption_J>0.5"), parse_rule("adaption_J<-2")};

    check_rules(rules, warn);

    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NE(lines[0].find("'adaption_J' of stats.csv is now named 'adaptation_J'"),
              std::string::npos)
        << lines[0];
    const CsvTable table = parse_csv("frame,adaptation_J\n1,0\n2,0.6\n", "stats.csv");
    EXPECT_EQ(
        broken_rules(rules, table),
        (std::vector<std::string>{"frame 2: adaptation_J = 0.6: fails --fail-on adaption_J>0.5"}));
}

TEST(Acceptance, ExpectationsMayNameARenamedColumnOfTheStatisticsAlone) {
    std::vector<std::string> lines;
    std::vector<Expectation> expectations{{.column = "adaption_J", .place = "e.toml: expect[0]"},
                                          {.file = "images", .column = "adaption_J"},
                                          {.column = "stretch_max"}};

    take_current_names(expectations, [&](const std::string& line) { lines.push_back(line); });

    EXPECT_EQ(expectations[0].column, "adaptation_J");
    EXPECT_EQ(expectations[1].column, "adaption_J");
    EXPECT_EQ(expectations[2].column, "stretch_max");
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_TRUE(lines[0].starts_with("e.toml: expect[0]: ")) << lines[0];
}

} // namespace
} // namespace weft
