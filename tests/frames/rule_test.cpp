#include "base/error.h"
#include "frames/rule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

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

} // namespace
} // namespace weft
