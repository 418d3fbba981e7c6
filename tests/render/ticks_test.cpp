#include "render/ticks.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

TEST(Ticks, AreRoundNumbersThatIncludeRoundEnds) {
    const Ticks ticks = round_ticks(0.9, 1.2, 8);

    ASSERT_EQ(ticks.values.size(), 7U);
    for (std::size_t i = 0; i < ticks.values.size(); ++i) {
        EXPECT_NEAR(ticks.values[i], 0.9 + 0.05 * static_cast<double>(i), 1e-12);
    }
    EXPECT_EQ(ticks.decimals, 2);
}

TEST(Ticks, StayInsideAndWithinTheirNumberForAnyRange) {
    const std::vector<std::array<double, 2>> ranges{{-10.0, 10.0},  {0.0, 100.0},    {0.93, 1.17},
                                                    {0.0, 2.0},     {-3e-7, 4e-7},   {1e6, 1.1e6},
                                                    {0.999, 1.001}, {-0.013, 7777.0}};
    for (const auto& [low, high] : ranges) {
        const Ticks ticks = round_ticks(low, high, 8);

        EXPECT_GE(ticks.values.size(), 3U) << low << " " << high;
        EXPECT_LE(ticks.values.size(), 8U) << low << " " << high;
        for (std::size_t i = 0; i < ticks.values.size(); ++i) {
            EXPECT_GE(ticks.values[i], low);
            EXPECT_LE(ticks.values[i], high);
            if (i > 0) {
                EXPECT_NE(format_number(ticks.values[i], ticks.decimals),
                          format_number(ticks.values[i - 1], ticks.decimals))
                    << low << " " << high;
            }
        }
    }
}

TEST(Ticks, NumbersHaveTheirDigitsAndNoNegativeZero) {
    EXPECT_EQ(format_number(1.2, 2), "1.20");
    EXPECT_EQ(format_number(-0.0001, 2), "0.00");
    EXPECT_EQ(format_number(-10.0, 0), "-10");
    EXPECT_EQ(format_number(2.5e7, 0), "2.5e+07");
}

} // namespace
} // namespace weft
