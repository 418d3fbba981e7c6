#include "render/picture_stats.h"

namespace weft {

PictureStats count_values(const ValuePicture& values, const ColourScale& scale) {
    std::size_t covered = 0;
    std::size_t above = 0;
    std::size_t below = 0;
    for (std::size_t i = 0; i < values.values.size(); ++i) {
        if (values.cloth[i] == 0) {
            continue;
        }
        ++covered;
        above += static_cast<double>(values.values[i]) > scale.high ? 1U : 0U;
        below += static_cast<double>(values.values[i]) < scale.low ? 1U : 0U;
    }
    const auto share = [](std::size_t part, std::size_t whole) {
        return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
    };
    PictureStats stats;
    stats.covered_share = share(covered, values.values.size());
    stats.above_share = share(above, covered);
    stats.below_share = share(below, covered);
    return stats;
}

std::array<double, 3> mean_colour(const Image& image) {
    std::array<std::size_t, 3> sum{};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        sum[i % 3] += image.rgb[i];
    }
    const double scale =
        image.rgb.empty() ? 0.0 : 3.0 / (255.0 * static_cast<double>(image.rgb.size()));
    return {static_cast<double>(sum[0]) * scale, static_cast<double>(sum[1]) * scale,
            static_cast<double>(sum[2]) * scale};
}

} // namespace weft
