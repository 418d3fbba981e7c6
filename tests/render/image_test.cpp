#include "render/image.h"
#include "support/golden.h"

#include <gtest/gtest.h>

namespace weft {
namespace {

Image pattern(int width, int height) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        image.rgb[i] = static_cast<std::uint8_t>(i * i / 7);
    }
    return image;
}

TEST(Png, ReadsBackToTheSamePixels) {
    for (const auto& [width, height] :
         std::vector<std::array<int, 2>>{{1, 1}, {3, 2}, {320, 180}, {257, 31}}) {
        const Image image = pattern(width, height);

        const Image back = test::decode_png(encode_png(image));

        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
        EXPECT_EQ(back.rgb, image.rgb);
    }
}

TEST(Png, EqualPicturesGiveEqualBytes) {
    EXPECT_EQ(encode_png(pattern(64, 64)), encode_png(pattern(64, 64)));
}

TEST(Png, AnEvenPictureIsPackedWell) {
    EXPECT_LT(encode_png(Image(1280, 720)).size(), 20000U);
}

} // namespace
} // namespace weft
