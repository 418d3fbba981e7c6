#include "render/text.h"

#include "base/error.h"

#include <cmath>
#include <span>
#include <string>
#include <vector>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

// WEFT_FONT_FILE is the path that CMake found; the assembler copies the file in as it stands.
asm(".section .rodata\n"
    ".balign 16\n"
    "weft_font_begin:\n"
    ".incbin \"" WEFT_FONT_FILE "\"\n"
    "weft_font_end:\n"
    ".byte 0\n"
    ".text\n");

extern "C" {
extern const unsigned char weft_font_begin[]; // NOLINT: named by the assembler
extern const unsigned char weft_font_end[];   // NOLINT
}

namespace weft {

namespace {

/// DejaVu Sans as a TrueType file, taken into the program when it is built (Bitstream Vera licence
/// with public domain additions), so that the program needs no font where it runs.
std::span<const unsigned char> font_data() {
    return {weft_font_begin, weft_font_end};
}

constexpr char32_t k_replacement = 0xFFFD;

} // namespace

struct Font::Face {
    stbtt_fontinfo info;
    float scale;
};

Font::Font(double size) : size_(size), face_(std::make_unique<Face>()) {
    if (stbtt_InitFont(&face_->info, font_data().data(), 0) == 0) {
        fail_disk("embedded font: not readable by stb_truetype");
    }
    face_->scale = stbtt_ScaleForPixelHeight(&face_->info, static_cast<float>(size));
}

Font::~Font() = default;
Font::Font(Font&&) noexcept = default;
Font& Font::operator=(Font&&) noexcept = default;

double Font::ascent() const {
    int ascent = 0;
    int descent = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(&face_->info, &ascent, &descent, &gap);
    return static_cast<double>(face_->scale) * ascent;
}

double Font::width(std::string_view text) const {
    int units = 0;
    for (std::size_t at = 0; at < text.size();) {
        int advance = 0;
        int bearing = 0;
        stbtt_GetCodepointHMetrics(&face_->info, static_cast<int>(next_code_point(text, at)),
                                   &advance, &bearing);
        units += advance;
    }
    return static_cast<double>(face_->scale) * units;
}

void Font::draw(Image& image,
                double x,
                double baseline,
                std::string_view text,
                const Colour& srgb,
                double opacity) const {
    const int y = static_cast<int>(std::lround(baseline)); // whole lines keep stems sharp
    std::vector<unsigned char> glyph;
    for (std::size_t at = 0; at < text.size();) {
        const int code = static_cast<int>(next_code_point(text, at));
        const int left = static_cast<int>(std::floor(x));
        const auto shift = static_cast<float>(x - left);
        int x0 = 0;
        int y0 = 0;
        int x1 = 0;
        int y1 = 0;
        stbtt_GetCodepointBitmapBoxSubpixel(&face_->info, code, face_->scale, face_->scale, shift,
                                            0.0F, &x0, &y0, &x1, &y1);
        const int width = x1 - x0;
        const int height = y1 - y0;
        if (width > 0 && height > 0) {
            glyph.assign(static_cast<std::size_t>(width * height), 0);
            stbtt_MakeCodepointBitmapSubpixel(&face_->info, glyph.data(), width, height, width,
                                              face_->scale, face_->scale, shift, 0.0F, code);
            for (int i = 0; i < width * height; ++i) {
                blend(image, left + x0 + i % width, y + y0 + i / width, srgb,
                      opacity * glyph[static_cast<std::size_t>(i)] / 255.0);
            }
        }
        int advance = 0;
        int bearing = 0;
        stbtt_GetCodepointHMetrics(&face_->info, code, &advance, &bearing);
        x += static_cast<double>(face_->scale) * advance;
    }
}

char32_t next_code_point(std::string_view text, std::size_t& at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(at++);
    if (first < 0x80) {
        return first;
    }
    const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : -1;
    if (more < 0) {
        return k_replacement;
    }
    char32_t code = first & (0x3FU >> more);
    for (int i = 0; i < more; ++i, ++at) {
        if (at >= text.size() || (byte(at) & 0xC0U) != 0x80U) {
            return k_replacement;
        }
        code = (code << 6U) | (byte(at) & 0x3FU);
    }
    return code;
}

std::string shortened(const Font& font, std::string_view text, double width) {
    if (font.width(text) <= width) {
        return std::string(text);
    }
    const std::string ellipsis = "\u2026";
    std::size_t end = 0;
    for (std::size_t at = 0; at < text.size();) {
        next_code_point(text, at);
        if (font.width(std::string(text.substr(0, at)) + ellipsis) > width) {
            break;
        }
        end = at;
    }
    return std::string(text.substr(0, end)) + ellipsis;
}

} // namespace weft
