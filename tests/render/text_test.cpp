#include "render/text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

constexpr Colour k_white{1.0F, 1.0F, 1.0F};

/// Box around the pixels that are not black.
Rect inked(const Image& image) {
    int x0 = image.width;
    int y0 = image.height;
    int x1 = -1;
    int y1 = -1;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.pixel(x, y)[0] > 0) {
                x0 = std::min(x0, x);
                y0 = std::min(y0, y);
                x1 = std::max(x1, x);
                y1 = std::max(y1, y);
            }
        }
    }
    return {double(x0), double(y0), double(x1 - x0 + 1), double(y1 - y0 + 1)};
}

TEST(Text, InkStandsOnTheBaselineWithinTheAdvance) {
    const Font font(20.0);
    Image image(200, 60);

    font.draw(image, 10.0, 40.0, "HHH", k_white);

    const Rect ink = inked(image);
    EXPECT_DOUBLE_EQ(ink.bottom(), 40.0);
    EXPECT_GE(ink.x, 10.0);
    EXPECT_LE(ink.right(), 10.0 + font.width("HHH") + 1.0);
    // an H of DejaVu Sans is 1493 units high, a line 1901 + 483
    EXPECT_NEAR(ink.height, 20.0 * 1493.0 / 2384.0, 1.0);
}

TEST(Text, WidthAddsUpAndDigitsAreEquallyWide) {
    const Font font(15.0);

    EXPECT_NEAR(font.width("ab"), font.width("a") + font.width("b"), 1e-9);
    EXPECT_DOUBLE_EQ(font.width("1.11"), font.width("8.88"));
    EXPECT_DOUBLE_EQ(font.width(""), 0.0);
}

TEST(Text, IsClippedAtThePictureEdges) {
    const Font font(30.0);
    Image image(20, 20);

    font.draw(image, -10.0, 5.0, "WWW", k_white);
    font.draw(image, 15.0, 30.0, "WWW", k_white);

    EXPECT_GT(inked(image).width, 0.0);
}

TEST(Text, ReadsUtf8AndMarksBrokenBytes) {
    std::size_t at = 0;
    const std::string text = "a\u00e9\u20ac";
    EXPECT_EQ(next_code_point(text, at), U'a');
    EXPECT_EQ(next_code_point(text, at), U'\u00e9');
    EXPECT_EQ(next_code_point(text, at), U'\u20ac');
    EXPECT_EQ(at, text.size());

    for (const std::string broken : {"\xff", "\xe2\x82", "\x80"}) {
        at = 0;
        EXPECT_EQ(next_code_point(broken, at), U'\ufffd');
        EXPECT_LE(at, broken.size());
    }
}

TEST(Text, TooLongALineEndsInAnEllipsisWithinTheWidth) {
    const Font font(15.0);
    const std::string line = "a very long name of a very long garment";

    const std::string cut = shortened(font, line, 100.0);

    EXPECT_LE(font.width(cut), 100.0);
    EXPECT_GT(font.width(cut), 80.0);
    EXPECT_EQ(cut.substr(cut.size() - 3), "\u2026");
    EXPECT_EQ(shortened(font, "short", 100.0), "short");
}

} // namespace
} // namespace weft
