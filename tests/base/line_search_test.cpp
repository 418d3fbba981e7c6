#include "base/line_search.h"

#include <gtest/gtest.h>

namespace weft {

TEST(LineSearch, BacktrackingTakesTheFirstStepThatIsAccepted) {
    int tried = 0;
    const auto accept = [&](double alpha) {
        ++tried;
        return alpha <= 0.3;
    };

    EXPECT_EQ(backtrack(1.0, 10, accept), 0.25);
    EXPECT_EQ(tried, 3);
}

TEST(LineSearch, BacktrackingEndsAtHalfTheLastStepWhenNoneIsAccepted) {
    EXPECT_EQ(backtrack(1.0, 4, [](double) { return false; }), 1.0 / 16.0);
}

TEST(LineSearch, FindsTheMinimumOfAParabolaInsideAndBeyondTheFirstBracket) {
    for (const double minimum : {0.02, 0.7, 1.0, 5.0, 15.0}) {
        const auto slope = [&](double alpha) { return alpha - minimum; };

        EXPECT_NEAR(find_minimum(slope, 0.1), minimum, 0.1 * minimum);
    }
}

TEST(LineSearch, FindsTheMinimumAtAKink) {
    const auto slope = [](double alpha) { // a spring that is met at 0.4
        return -1.0 + (alpha > 0.4 ? 1e6 * (alpha - 0.4) : 0.0);
    };

    EXPECT_NEAR(find_minimum(slope, 0.1), 0.4 + 1e-6, 1e-7);
}

TEST(LineSearch, GoesNoFurtherThanItsLongestStepDownAnEndlessSlope) {
    EXPECT_EQ(find_minimum([](double) { return -1.0; }, 0.1), 16.0);
}

} // namespace weft
