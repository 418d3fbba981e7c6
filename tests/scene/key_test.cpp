#include "scene/key.h"
#include "scene/scene_keys.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

TEST(Range, TakesItsBoundsFromItsWords) {
    const Range positive("> 0");
    EXPECT_FALSE(positive.holds(0.0));
    EXPECT_TRUE(positive.holds(1e-300));
    EXPECT_TRUE(positive.holds(1e300));
    const Range fraction(">= 0 and < 1");
    EXPECT_TRUE(fraction.holds(0.0));
    EXPECT_FALSE(fraction.holds(1.0));
    const Range tolerance("> 0 and <= 0.1");
    EXPECT_FALSE(tolerance.holds(0.0));
    EXPECT_TRUE(tolerance.holds(0.1));
    EXPECT_FALSE(tolerance.holds(0.11));
    const Range count("0 (automatic) to 100000");
    EXPECT_TRUE(count.holds(0.0));
    EXPECT_TRUE(count.holds(100000.0));
    EXPECT_FALSE(count.holds(-1.0));
    EXPECT_FALSE(count.holds(100001.0));
    EXPECT_FALSE(Range("0 to below 1").holds(1.0));
}

TEST(Range, LetsNoNumberPassThatIsNone) {
    EXPECT_FALSE(Range("> 0").holds(std::nan("")));
    EXPECT_FALSE(Range("0 to 1").holds(std::nan("")));
}

TEST(Range, TakesNoBoundFromItsExplanation) {
    const Range stretch("> 1, at most > 3 in practice");
    EXPECT_TRUE(stretch.holds(2.0));
    EXPECT_EQ(stretch.short_text(), "> 1");
}

TEST(ProblemOf, NamesTheComponentTheValueAndWhatIsAllowed) {
    Vec2 size(1.0, -2.0);
    const Keys keys{{"size", &size, "m", "> 0", "two edges"}};

    EXPECT_EQ(problem_of(keys), "size[1] = -2: must be > 0 m");
}

TEST(ProblemOf, NamesKeysOfATableOnOneLineBelowItsOwnKey) {
    int cells = 0;
    const Keys keys{{"grid", Inline{{{"cells", &cells, "", "1 to 4096", "cells"}}}, "", "", ""}};

    EXPECT_EQ(problem_of(keys), "grid.cells = 0: must be 1 to 4096");
}

TEST(ProblemOf, FindsNothingWrongWithDefaults) {
    EXPECT_EQ(problem(SceneParams{}), "");
    EXPECT_EQ(problem(FabricParams{}), "");
    EXPECT_EQ(problem(AdaptParams{}), "");
    EXPECT_EQ(problem(PinParams{}), "");
    EXPECT_EQ(problem(ClothParams{}), "");
    EXPECT_EQ(problem(RigidParams{}), "");
    EXPECT_EQ(problem(ObstacleParams{}), "");
    EXPECT_EQ(problem(AttachParams{}), "");
    EXPECT_EQ(problem(RenderParams{}), "");
}

} // namespace
} // namespace weft
