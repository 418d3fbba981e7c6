#include "support/golden.h"

#include "base/atomic_file.h"
#include "render/image.h"
#include "support/paths.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace weft::test {

double mean_difference(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height) {
        return 255.0;
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        sum += std::abs(a.rgb[i] - b.rgb[i]);
    }
    return sum / static_cast<double>(a.rgb.size());
}

Image decode_png(const std::string& bytes) {
    int width = 0;
    int height = 0;
    int channels = 0;
    unsigned char* data =
        stbi_load_from_memory(reinterpret_cast<const unsigned char*>(bytes.data()),
                              static_cast<int>(bytes.size()), &width, &height, &channels, 3);
    if (data == nullptr) {
        throw std::runtime_error(std::string("png: ") + stbi_failure_reason());
    }
    Image image(width, height);
    std::copy(data, data + image.rgb.size(), image.rgb.begin());
    stbi_image_free(data);
    return image;
}

Image read_golden(const std::string& name) {
    return decode_png(read_file(source_path("tests/golden/" + name + ".png")));
}

namespace {

void keep(const Image& image, const std::string& name) {
    const auto folder = weft_binary().parent_path() / "golden";
    std::filesystem::create_directories(folder);
    write_atomically(folder / (name + ".png"), std::string_view(encode_png(image)));
}

} // namespace

double compare_with_golden(const Image& image, const std::string& name, double limit) {
    if (std::getenv("WEFT_UPDATE_GOLDEN") != nullptr) {
        write_atomically(source_path("tests/golden/" + name + ".png"),
                         std::string_view(encode_png(image)));
        return 0.0;
    }
    const Image golden = read_golden(name);
    const double difference = mean_difference(image, golden);
    if (difference > limit) {
        keep(image, name + ".actual");
        Image contrast(image.width, image.height);
        for (std::size_t i = 0; i < std::min(contrast.rgb.size(), golden.rgb.size()); ++i) {
            contrast.rgb[i] = static_cast<std::uint8_t>(
                std::clamp(128 + 8 * (image.rgb[i] - golden.rgb[i]), 0, 255));
        }
        keep(contrast, name + ".difference");
    }
    return difference;
}

} // namespace weft::test
