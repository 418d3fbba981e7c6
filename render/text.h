#pragma once

#include "render/canvas.h"

#include <memory>
#include <string_view>

namespace weft {

/// The embedded typeface (DejaVu Sans) at one size.
class Font {
public:
    /// @param size  line height without leading, pixels (about 1.4 times the height of an H)
    explicit Font(double size);
    ~Font();
    Font(Font&&) noexcept;
    Font& operator=(Font&&) noexcept;

    double size() const { return size_; }
    double ascent() const; ///< baseline below the top of a line, pixels
    /// Advance of a line of UTF-8, pixels; bytes that are not UTF-8 show as the replacement mark.
    double width(std::string_view text) const;
    /// Draws it with its left end at x and its baseline at y.
    void draw(Image& image,
              double x,
              double baseline,
              std::string_view text,
              const Colour& srgb,
              double opacity = 1.0) const;

private:
    struct Face;
    double size_;
    std::unique_ptr<Face> face_;
};

/// The next code point of UTF-8 `text` from `at`, which moves on; U+FFFD for a broken sequence.
char32_t next_code_point(std::string_view text, std::size_t& at);

/// The text itself when it is at most `width` wide in `font`, else its start and an ellipsis.
std::string shortened(const Font& font, std::string_view text, double width);

} // namespace weft
