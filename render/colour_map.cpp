#include "render/colour_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace weft {

namespace {

/// Published colour maps as 0xRRGGBB (sRGB): every fifth of their 256 entries, from 0 to 255.
/// Straight lines between these keep within 0.004 of the whole table (cividis 0.016, at a kink).
using ColourTable = std::array<std::uint32_t, 52>;

// S. van der Walt and N. Smith 2015, for matplotlib (CC0).
constexpr ColourTable k_viridis{
    0x440154, 0x46085c, 0x471063, 0x481769, 0x481d6f, 0x482475, 0x472a7a, 0x46307e, 0x453781,
    0x433d84, 0x414287, 0x3f4889, 0x3d4e8a, 0x3a538b, 0x38598c, 0x355e8d, 0x33638d, 0x31688e,
    0x2e6d8e, 0x2c718e, 0x2a768e, 0x297b8e, 0x27808e, 0x25848e, 0x23898e, 0x218e8d, 0x20928c,
    0x1f978b, 0x1e9c89, 0x1fa188, 0x21a585, 0x24aa83, 0x28ae80, 0x2eb37c, 0x35b779, 0x3dbc74,
    0x46c06f, 0x50c46a, 0x5ac864, 0x65cb5e, 0x70cf57, 0x7cd250, 0x89d548, 0x95d840, 0xa2da37,
    0xb0dd2f, 0xbddf26, 0xcae11f, 0xd8e219, 0xe5e419, 0xf1e51d, 0xfde725};

// J. Nuñez, C. Anderton and R. Renslow 2018, PLOS ONE 13(7) (CC0).
constexpr ColourTable k_cividis{
    0x00224e, 0x002656, 0x002a5f, 0x002d68, 0x003070, 0x083370, 0x163770, 0x203a6f, 0x273e6e,
    0x2e416d, 0x34456c, 0x3a486c, 0x3f4c6c, 0x444f6c, 0x49536c, 0x4e566c, 0x535a6d, 0x575d6d,
    0x5c616e, 0x60646f, 0x656870, 0x696b71, 0x6d6f72, 0x727274, 0x767676, 0x7a7a78, 0x7e7d78,
    0x838179, 0x888578, 0x8d8878, 0x928c78, 0x969077, 0x9b9476, 0xa09875, 0xa59c74, 0xaaa073,
    0xafa471, 0xb5a86f, 0xbaac6d, 0xbfb06b, 0xc4b468, 0xc9b965, 0xcfbd62, 0xd4c15f, 0xdac65b,
    0xdfca57, 0xe5cf52, 0xead34c, 0xf0d846, 0xf6dd3f, 0xfce236, 0xfee838};

// A. Mikhailov 2019, Google (Apache 2.0).
constexpr ColourTable k_turbo{
    0x30123b, 0x36215f, 0x3b2f80, 0x3f3e9c, 0x424bb5, 0x4559cb, 0x4666dd, 0x4773eb, 0x4680f6,
    0x458cfd, 0x4099ff, 0x38a5fb, 0x2fb2f4, 0x27bee9, 0x1fc9dd, 0x1ad4d0, 0x18ddc2, 0x1ae4b6,
    0x22ebaa, 0x2ff19b, 0x3ff68a, 0x52fa7a, 0x65fd69, 0x79fe59, 0x8bff4b, 0x9cfe40, 0xa9fb39,
    0xb7f735, 0xc3f134, 0xd0ea34, 0xdbe236, 0xe5d938, 0xeecf3a, 0xf5c53a, 0xfaba39, 0xfdae35,
    0xfea130, 0xfe932a, 0xfc8423, 0xf9751d, 0xf46617, 0xef5811, 0xe84b0c, 0xe14109, 0xd83706,
    0xce2d04, 0xc32503, 0xb71d02, 0xa91601, 0x9b0f01, 0x8b0902, 0x7a0403};

Colour clamped(const Colour& c) {
    return {std::clamp(c[0], 0.0F, 1.0F), std::clamp(c[1], 0.0F, 1.0F),
            std::clamp(c[2], 0.0F, 1.0F)};
}

/// Straight lines between the entries of a table.
Colour interpolated(const ColourTable& table, float t) {
    const float place = t * static_cast<float>(table.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), table.size() - 2);
    const float w = place - static_cast<float>(i);
    const auto channel = [&](std::size_t entry, std::size_t c) {
        return static_cast<float>((table[entry] >> (16 - 8 * c)) & 0xFFU) / 255.0F;
    };
    Colour c{};
    for (std::size_t k = 0; k < 3; ++k) {
        c[k] = (1.0F - w) * channel(i, k) + w * channel(i + 1, k);
    }
    return c;
}

Colour seed(float t) {
    return {t, 1.0F - t, 0.0F};
}

Colour viridis(float t) {
    return interpolated(k_viridis, t);
}

Colour cividis(float t) {
    return interpolated(k_cividis, t);
}

Colour turbo(float t) {
    return interpolated(k_turbo, t);
}

/// Moreland's polar form of CIELAB: magnitude, saturation angle, hue angle.
struct Msh {
    double m, s, h;
};

constexpr std::array<double, 3> k_white{0.95047, 1.0, 1.08883}; // D65

/// Linear RGB of a colour in Msh. Moreland 2009, section 4, and CIE 1976 L*a*b*.
Colour srgb_from_msh(const Msh& c) {
    const double l = c.m * std::cos(c.s);
    const double a = c.m * std::sin(c.s) * std::cos(c.h);
    const double b = c.m * std::sin(c.s) * std::sin(c.h);
    const auto inverse = [](double f) {
        return f > 6.0 / 29.0 ? f * f * f : (f - 16.0 / 116.0) * 3.0 * (6.0 / 29.0) * (6.0 / 29.0);
    };
    const double fy = (l + 16.0) / 116.0;
    const double x = k_white[0] * inverse(fy + a / 500.0);
    const double y = k_white[1] * inverse(fy);
    const double z = k_white[2] * inverse(fy - b / 200.0);
    return clamped({srgb_from_linear(static_cast<float>(3.2406 * x - 1.5372 * y - 0.4986 * z)),
                    srgb_from_linear(static_cast<float>(-0.9689 * x + 1.8758 * y + 0.0415 * z)),
                    srgb_from_linear(static_cast<float>(0.0557 * x - 0.2040 * y + 1.0570 * z))});
}

// Moreland's ends, rgb (59, 76, 192) and (180, 4, 38), in Msh, and his rule for a white of M = 88:
// the hue turns away from the saturated end, by this angle, as it fades to grey.
constexpr Msh k_cool{80.0, 1.08, -1.1};
constexpr Msh k_warm{80.0, 1.08, 0.5};
constexpr double k_white_m = 88.0;

double hue_at_white(const Msh& end) {
    const double spin =
        end.s * std::sqrt(k_white_m * k_white_m - end.m * end.m) / (end.m * std::sin(end.s));
    return end.h > -std::numbers::pi / 3.0 ? end.h + spin : end.h - spin;
}

Colour coolwarm(float t) {
    const Msh& end = t < 0.5F ? k_cool : k_warm;
    const double w = std::abs(2.0 * static_cast<double>(t) - 1.0); // 0 grey, 1 saturated
    return srgb_from_msh({k_white_m + w * (end.m - k_white_m), w * end.s,
                          (1.0 - w) * hue_at_white(end) + w * end.h});
}

constexpr Colour k_magenta{0.93F, 0.13F, 0.80F};
constexpr Colour k_cyan{0.05F, 0.80F, 0.86F};
constexpr Colour k_azure{0.12F, 0.50F, 1.0F};
constexpr Colour k_snow{0.90F, 0.90F, 1.0F};

// No outside colour is near to a colour of its own map.
constexpr std::array<ColourMap, 5> k_maps{{
    {"seed", seed, false, k_azure, k_magenta},
    {"coolwarm", coolwarm, true, k_cyan, k_magenta},
    {"viridis", viridis, false, k_azure, k_magenta},
    {"turbo", turbo, false, k_snow, k_magenta},
    {"cividis", cividis, false, k_cyan, k_magenta},
}};

} // namespace

float srgb_from_linear(float linear) {
    const float x = std::clamp(linear, 0.0F, 1.0F);
    return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
}

float linear_from_srgb(float srgb) {
    return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
}

Colour linear_from_srgb(const Colour& srgb) {
    return {linear_from_srgb(srgb[0]), linear_from_srgb(srgb[1]), linear_from_srgb(srgb[2])};
}

std::span<const ColourMap> colour_maps() {
    return k_maps;
}

const ColourMap* find_colour_map(std::string_view name) {
    const auto found = std::find_if(k_maps.begin(), k_maps.end(),
                                    [&](const ColourMap& map) { return map.name == name; });
    return found == k_maps.end() ? nullptr : &*found;
}

float ColourScale::place(double value) const {
    assert(map != nullptr && low < high);
    double t = 0.0;
    if (!map->diverging) {
        t = (value - low) / (high - low);
    } else if (value >= neutral) { // then the warm half ends at high, or at the cool half's mirror
        t = 0.5 + 0.5 * (value - neutral) / (high > neutral ? high - neutral : neutral - low);
    } else {
        t = 0.5 - 0.5 * (neutral - value) / (low < neutral ? neutral - low : high - neutral);
    }
    return static_cast<float>(std::clamp(t, 0.0, 1.0));
}

Colour ColourScale::colour(double value) const {
    if (value < low) {
        return map->below;
    }
    return value > high ? map->above : map->colour(place(value));
}

std::vector<Colour> lookup_table(const ColourScale& scale, int count) {
    assert(count >= 2);
    std::vector<Colour> table;
    table.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double value = scale.low + (scale.high - scale.low) * i / (count - 1);
        table.push_back(linear_from_srgb(scale.map->colour(scale.place(value))));
    }
    return table;
}

} // namespace weft
