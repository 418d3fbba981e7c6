#include "render/legend.h"
#include "support/picture_frames.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace weft {
namespace {

ColourScale stretch_scale() {
    return {find_colour_map("coolwarm"), 0.9, 1.2, 1.0};
}

Frame stretched_square() {
    Frame frame;
    frame.number = 12;
    frame.time = 0.44;
    frame.objects.push_back(
        test::square_cloth(1.0, 4, [](double u, double) { return 0.95 + 0.2 * u; }));
    return frame;
}

bool has_text(const LegendLayout& layout, const std::string& text) {
    return std::any_of(layout.texts.begin(), layout.texts.end(),
                       [&](const LegendText& line) { return line.text == text; });
}

TEST(Legend, SaysQuantityUnitLeastGreatestFrameTimeObjectAndFabric) {
    const LegendLayout layout =
        lay_out_legend(describe_frame(stretched_square(), 0, stretch_scale()), 1280, 720);

    for (const char* text : {"principal stretch", "1 = rest length", "greatest  1.150",
                             "least  0.950", "frame 12   0.440 s", "square \u00b7 cotton", "0.90",
                             "1.00", "1.20", "> 1.20", "< 0.90"}) {
        EXPECT_TRUE(has_text(layout, text)) << text;
    }
}

TEST(Legend, FitsIntoAnySizeOfPictureWithoutOverlap) {
    const LegendContent content = describe_frame(stretched_square(), 0, stretch_scale());
    for (const auto& [width, height] : std::vector<std::array<int, 2>>{
             {1280, 720}, {640, 360}, {1920, 1080}, {320, 180}, {200, 900}, {3840, 2160}}) {
        const LegendLayout layout = lay_out_legend(content, width, height);

        const Rect picture{0.0, 0.0, double(width), double(height)};
        EXPECT_TRUE(picture.contains(layout.panel)) << width << " x " << height;
        for (const Rect& part : {layout.bar, layout.above, layout.below}) {
            EXPECT_TRUE(layout.panel.contains(part)) << width << " x " << height;
        }
        for (std::size_t i = 0; i < layout.texts.size(); ++i) {
            const Rect& a = layout.texts[i].box;
            EXPECT_TRUE(layout.panel.contains(a)) << layout.texts[i].text << " " << width;
            for (std::size_t j = 0; j < i; ++j) {
                const Rect& b = layout.texts[j].box; // letters fill two thirds of a line
                const double apart =
                    std::max(std::abs(a.y - b.y), a.x >= b.right() || b.x >= a.right() ? 1e9 : 0.0);
                EXPECT_GT(apart, 0.66 * std::min(a.height, b.height))
                    << layout.texts[i].text << " on " << layout.texts[j].text << " " << width;
            }
        }
    }
}

TEST(Legend, TextIsAtLeastTenPixelsAt360LinesAndGrowsWithThePicture) {
    const LegendContent content = describe_frame(stretched_square(), 0, stretch_scale());

    const auto smallest = [&](int width, int height) {
        const LegendLayout layout = lay_out_legend(content, width, height);
        return std::min_element(layout.texts.begin(), layout.texts.end(),
                                [](const auto& a, const auto& b) { return a.size < b.size; })
            ->box.height;
    };
    EXPECT_GE(smallest(640, 360), 9.0);
    EXPECT_NEAR(smallest(1280, 720), 15.0, 0.01);
    EXPECT_NEAR(smallest(1920, 1080), 22.5, 0.01);
}

TEST(Legend, MarkersStandAtLeastAndGreatest) {
    const LegendLayout layout =
        lay_out_legend(describe_frame(stretched_square(), 0, stretch_scale()), 1280, 720);

    ASSERT_EQ(layout.markers.size(), 2U);
    const auto height = [&](double value) {
        return layout.bar.bottom() - (value - 0.9) / 0.3 * layout.bar.height;
    };
    EXPECT_NEAR(layout.markers[0][1], height(0.95), 0.01);
    EXPECT_NEAR(layout.markers[1][1], height(1.15), 0.01);
}

TEST(Legend, PaintsTheColoursOfTheScaleAndTheText) {
    Image image(1280, 720);
    const LegendContent content = describe_frame(stretched_square(), 0, stretch_scale());
    const LegendLayout layout = lay_out_legend(content, 1280, 720);

    draw_legend(image, content);

    const auto expect_at = [&](double x, double y, const Colour& colour) {
        const std::uint8_t* pixel = image.pixel(static_cast<int>(x), static_cast<int>(y));
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(pixel[i], 255.0F * colour[i], 1.0F);
        }
    };
    const double x = layout.bar.x + 0.5 * layout.bar.width;
    for (const double value : {0.92, 1.0, 1.1, 1.18}) {
        const double y = layout.bar.bottom() - (value - 0.9) / 0.3 * layout.bar.height;
        const double shown =
            0.9 + 0.3 * (layout.bar.bottom() - (std::floor(y) + 0.5)) / layout.bar.height;
        expect_at(x, y, stretch_scale().colour(shown));
    }
    expect_at(x, layout.above.y + 3.0, stretch_scale().map->above);
    expect_at(x, layout.below.y + 3.0, stretch_scale().map->below);
    for (const LegendText& text : layout.texts) {
        int brightest = 0;
        for (int py = static_cast<int>(text.box.y); py < static_cast<int>(text.box.bottom());
             ++py) {
            for (int px = static_cast<int>(text.box.x); px < static_cast<int>(text.box.right());
                 ++px) {
                brightest = std::max(brightest, int{image.pixel(px, py)[1]});
            }
        }
        EXPECT_GT(brightest, 150) << text.text;
    }
}

TEST(Legend, WithoutClothSaysNothingOfLeastAndGreatest) {
    Frame frame;
    frame.objects.resize(1);
    frame.objects[0].kind = ObjectKind::Obstacle;

    const LegendContent content = describe_frame(frame, 0, stretch_scale());

    EXPECT_FALSE(content.has_values);
    EXPECT_TRUE(lay_out_legend(content, 640, 360).markers.empty());
}

TEST(Legend, NamesAtMostFourGarments) {
    Frame frame = stretched_square();
    for (int i = 0; i < 5; ++i) {
        frame.objects.push_back(frame.objects[0]);
    }

    const LegendContent content = describe_frame(frame, 0, stretch_scale());

    ASSERT_EQ(content.objects.size(), 5U);
    EXPECT_EQ(content.objects.back(), "and 2 more");
}

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
