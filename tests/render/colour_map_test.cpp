#include "render/colour_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

void expect_colour(const Colour& actual, const Colour& expected, float tolerance) {
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
    }
}

Colour at(const char* map, float t) {
    return find_colour_map(map)->colour(t);
}

Colour rgb(int r, int g, int b) {
    return {static_cast<float>(r) / 255.0F, static_cast<float>(g) / 255.0F,
            static_cast<float>(b) / 255.0F};
}

TEST(ColourMap, SeedIsTheStraightRampFromGreenToRed) {
    for (const float t : {0.0F, 0.25F, 0.5F, 0.75F, 1.0F}) {
        expect_colour(at("seed", t), {t, 1.0F - t, 0.0F}, 0.0F);
    }
}

TEST(ColourMap, CoolwarmHasThePublishedEndsAndMiddle) {
    // Moreland 2009, table of the diverging map used as default in ParaView
    expect_colour(at("coolwarm", 0.0F), rgb(59, 76, 192), 0.008F);
    expect_colour(at("coolwarm", 0.5F), rgb(221, 221, 221), 0.008F);
    expect_colour(at("coolwarm", 1.0F), rgb(180, 4, 38), 0.008F);
    expect_colour(at("coolwarm", 0.25F), rgb(141, 176, 254), 0.012F);
    expect_colour(at("coolwarm", 0.75F), rgb(244, 154, 123), 0.012F);
}

TEST(ColourMap, TablesAreThePublishedOnes) {
    // entries 0, 128 and 255 of each; 128 lies between two of ours
    const float mid = 128.0F / 255.0F;
    expect_colour(at("viridis", 0.0F), {0.267004F, 0.004874F, 0.329415F}, 0.004F);
    expect_colour(at("viridis", mid), {0.127568F, 0.566949F, 0.550556F}, 0.004F);
    expect_colour(at("viridis", 1.0F), {0.993248F, 0.906157F, 0.143936F}, 0.004F);
    expect_colour(at("cividis", 0.0F), {0.000000F, 0.135112F, 0.304751F}, 0.004F);
    expect_colour(at("cividis", mid), {0.488697F, 0.485318F, 0.471008F}, 0.004F);
    expect_colour(at("cividis", 1.0F), {0.995737F, 0.909344F, 0.217772F}, 0.004F);
    expect_colour(at("turbo", 0.0F), {0.189950F, 0.071760F, 0.232170F}, 0.004F);
    expect_colour(at("turbo", mid), {0.643620F, 0.989990F, 0.233560F}, 0.004F);
    expect_colour(at("turbo", 1.0F), {0.479600F, 0.015830F, 0.010550F}, 0.004F);
}

TEST(ColourMap, ColoursOutsideTheRangeAreFarFromEveryColourOfTheMap) {
    for (const ColourMap& map : colour_maps()) {
        for (const Colour& outside : {map.below, map.above}) {
            for (int i = 0; i <= 100; ++i) {
                const Colour inside = map.colour(static_cast<float>(i) / 100.0F);
                const float distance = std::hypot(inside[0] - outside[0], inside[1] - outside[1],
                                                  inside[2] - outside[2]);
                EXPECT_GT(distance, 0.25F) << map.name << " at " << i << " %";
            }
        }
    }
}

TEST(ColourMap, AnUnknownNameGivesNone) {
    EXPECT_EQ(find_colour_map("jet"), nullptr);
}

TEST(ColourScale, ADivergingMapIsNeutralAtTheNeutralValueOfALopsidedRange) {
    const ColourScale scale{find_colour_map("coolwarm"), 0.9, 1.2, 1.0};

    EXPECT_FLOAT_EQ(scale.place(0.9), 0.0F);
    EXPECT_FLOAT_EQ(scale.place(0.95), 0.25F);
    EXPECT_FLOAT_EQ(scale.place(1.0), 0.5F);
    EXPECT_FLOAT_EQ(scale.place(1.1), 0.75F);
    EXPECT_FLOAT_EQ(scale.place(1.2), 1.0F);
    expect_colour(scale.colour(1.0), rgb(221, 221, 221), 0.008F);
}

TEST(ColourScale, ANeutralValueAtTheEndOfTheRangeUsesOneHalfOfADivergingMap) {
    const ColourScale scale{find_colour_map("coolwarm"), 0.0, 100.0, 0.0};

    EXPECT_FLOAT_EQ(scale.place(0.0), 0.5F);
    EXPECT_FLOAT_EQ(scale.place(50.0), 0.75F);
    EXPECT_FLOAT_EQ(scale.place(100.0), 1.0F);
}

TEST(ColourScale, AnyOtherMapRunsStraightOverTheRange) {
    const ColourScale scale{find_colour_map("viridis"), 0.9, 1.2, 1.0};

    EXPECT_FLOAT_EQ(scale.place(0.9), 0.0F);
    EXPECT_NEAR(scale.place(1.05), 0.5F, 1e-6F);
    EXPECT_FLOAT_EQ(scale.place(1.2), 1.0F);
}

TEST(ColourScale, ValuesOutsideTheRangeHaveTheirOwnColours) {
    const ColourScale scale{find_colour_map("seed"), 0.9, 1.2, 1.0};

    EXPECT_EQ(scale.colour(0.8999), scale.map->below);
    EXPECT_EQ(scale.colour(1.2001), scale.map->above);
    EXPECT_EQ(scale.colour(0.9), (Colour{0.0F, 1.0F, 0.0F}));
    EXPECT_EQ(scale.colour(1.2), (Colour{1.0F, 0.0F, 0.0F}));
}

TEST(ColourScale, LookupTableHoldsTheColoursAsLight) {
    const ColourScale scale{find_colour_map("viridis"), 0.0, 1.0, 0.0};

    const std::vector<Colour> table = lookup_table(scale, 11);

    ASSERT_EQ(table.size(), 11U);
    for (std::size_t i = 0; i < table.size(); ++i) {
        expect_colour(table[i], linear_from_srgb(scale.colour(static_cast<double>(i) / 10.0)),
                      1e-5F);
    }
}

TEST(Srgb, RoundTripsAndHasTheStandardMiddle) {
    for (int i = 0; i <= 255; ++i) {
        const float x = static_cast<float>(i) / 255.0F;
        EXPECT_NEAR(srgb_from_linear(linear_from_srgb(x)), x, 1e-5F);
    }
    EXPECT_NEAR(linear_from_srgb(0.5F), 0.21404F, 1e-4F); // IEC 61966-2-1
}

} // namespace
} // namespace weft
