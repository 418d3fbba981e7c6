#include "render/legend.h"

#include "render/text.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace weft {

namespace {

const Colour k_panel{0.05F, 0.055F, 0.065F};
constexpr double k_panel_opacity = 0.50;
const Colour k_text{0.95F, 0.95F, 0.94F};
const Colour k_quiet{0.70F, 0.71F, 0.72F};

// Lengths in pixels of a picture with 720 lines.
constexpr double k_margin = 18.0;
constexpr double k_padding = 14.0;
constexpr double k_title_size = 17.0;
constexpr double k_text_size = 15.0;
constexpr double k_line = 1.24; // line distance over text size
constexpr double k_gap = 9.0;
constexpr double k_bar_width = 16.0;
constexpr double k_bar_height = 216.0;
constexpr double k_patch_height = 13.0;
constexpr double k_marker = 8.0;
constexpr double k_tick = 5.0;
constexpr int k_most_ticks = 8;
constexpr double k_least_scale = 10.0 / k_text_size; // text of 10 pixels
constexpr double k_widest_text = 250.0;
constexpr double k_widest_fraction = 0.45; // width of the panel over that of the picture
constexpr std::size_t k_most_objects = 4;

/// Sets lines below one another and knows how far down and right it has come.
class Setter {
public:
    Setter(LegendLayout& layout, double scale) : layout_(layout), scale_(scale) {}

    double x = 0.0, y = 0.0; ///< where the next line begins
    double right = 0.0;      ///< right end of the widest line so far

    void text(const std::string& words, double size, bool quiet) {
        text_at(x, y, words, size, quiet);
        y += size * k_line * scale_;
    }

    void text_at(double left, double top, const std::string& words, double size, bool quiet) {
        const Font font(size * scale_);
        const std::string shown = shortened(font, words, k_widest_text * scale_);
        const double width = font.width(shown);
        layout_.texts.push_back({{left, top, width, font.size()}, font.size(), quiet, shown});
        right = std::max(right, left + width);
    }

private:
    LegendLayout& layout_;
    double scale_;
};

double height_on_bar(const LegendLayout& layout, const ColourScale& scale, double value) {
    if (value > scale.high) {
        return layout.above.y + 0.5 * layout.above.height;
    }
    if (value < scale.low) {
        return layout.below.y + 0.5 * layout.below.height;
    }
    return layout.bar.bottom() - (value - scale.low) / (scale.high - scale.low) * layout.bar.height;
}

/// The bar with its patches, numbers and markers; moves the setter below it.
void set_bar(LegendLayout& layout, Setter& set, const LegendContent& content, double s) {
    const Ticks ticks = round_ticks(content.scale.low, content.scale.high, k_most_ticks);
    const double bar_x = std::round(set.x + (k_marker + 3.0) * s);
    const double width = std::round(k_bar_width * s);
    const double patch = std::round(k_patch_height * s);
    const double gap = std::max(3.0, std::round(10.0 * s)); // keeps the labels apart
    layout.above = {bar_x, std::round(set.y), width, patch};
    layout.bar = {bar_x, layout.above.bottom() + gap, width, std::round(k_bar_height * s)};
    layout.below = {bar_x, layout.bar.bottom() + gap, width, patch};

    const double text_x = layout.bar.right() + (k_tick + 5.0) * s;
    const auto label = [&](double middle, const std::string& words, bool quiet) {
        set.text_at(text_x, middle - 0.5 * k_text_size * s, words, k_text_size, quiet);
    };
    const auto middle = [](const Rect& r) { return r.y + 0.5 * r.height; };
    label(middle(layout.above), "> " + format_number(content.scale.high, ticks.decimals), true);
    label(middle(layout.below), "< " + format_number(content.scale.low, ticks.decimals), true);
    for (const double value : ticks.values) {
        const double y = height_on_bar(layout, content.scale, value);
        layout.ticks.push_back({layout.bar.right(), y});
        label(y, format_number(value, ticks.decimals), false);
    }
    if (content.has_values) {
        for (const double value : {content.least, content.greatest}) {
            layout.markers.push_back({layout.bar.x, height_on_bar(layout, content.scale, value)});
        }
    }
    set.y = layout.below.bottom() + k_gap * s;
}

LegendLayout lay_out(const LegendContent& content, double s) {
    LegendLayout layout;
    layout.scale = s;
    Setter set(layout, s);
    set.x = k_padding * s;
    set.y = k_padding * s;
    set.text(content.title, k_title_size, false);
    if (!content.unit.empty()) {
        set.text(content.unit, k_text_size, true);
    }
    set.y += k_gap * s;
    set_bar(layout, set, content, s);
    if (content.has_values) {
        const int decimals =
            round_ticks(content.scale.low, content.scale.high, k_most_ticks).decimals + 1;
        set.text("greatest  " + format_number(content.greatest, decimals), k_text_size, false);
        set.text("least  " + format_number(content.least, decimals), k_text_size, false);
        set.y += k_gap * s;
    }
    set.text(content.moment, k_text_size, false);
    for (const std::string& line : content.moment_notes) {
        set.text(line, k_text_size, false);
    }
    for (const std::string& line : content.objects) {
        set.text(line, k_text_size, true);
    }
    layout.panel = {0.0, 0.0, std::ceil(set.right + k_padding * s),
                    std::ceil(set.y + (k_padding - 3.0) * s)};
    return layout;
}

void move(LegendLayout& layout, double dx, double dy) {
    for (Rect* rect : {&layout.panel, &layout.bar, &layout.above, &layout.below}) {
        rect->x += dx;
        rect->y += dy;
    }
    for (auto* points : {&layout.ticks, &layout.markers}) {
        for (std::array<double, 2>& point : *points) {
            point[0] += dx;
            point[1] += dy;
        }
    }
    for (LegendText& text : layout.texts) {
        text.box.x += dx;
        text.box.y += dy;
    }
}

std::string unit_words(const Quantity& quantity) {
    if (quantity.unit == "1") {
        return quantity.neutral == 1.0 ? "1 = rest length" : "";
    }
    return "in " + std::string(quantity.unit);
}

} // namespace

LegendContent describe_frame(const Frame& frame, int quantity, const ColourScale& scale) {
    const Quantity& shown = k_quantities[static_cast<std::size_t>(quantity)];
    LegendContent content;
    content.title = shown.title;
    content.unit = unit_words(shown);
    content.scale = scale;
    content.moment = fmt::format("frame {}   {:.3f} s", frame.number, frame.time);
    std::size_t cloths = 0;
    for (const FrameObject& object : frame.objects) {
        if (!has_quantities(object.kind)) {
            continue;
        }
        for (const float value : object.values[static_cast<std::size_t>(quantity)]) {
            const auto v = static_cast<double>(value);
            content.least = content.has_values ? std::min(content.least, v) : v;
            content.greatest = content.has_values ? std::max(content.greatest, v) : v;
            content.has_values = true;
        }
        if (cloths++ < k_most_objects) {
            content.objects.push_back(object.name +
                                      (object.fabric.empty() ? "" : " \u00b7 " + object.fabric));
        }
    }
    if (cloths > k_most_objects) {
        content.objects.push_back(fmt::format("and {} more", cloths - k_most_objects));
    }
    return content;
}

LegendLayout lay_out_legend(const LegendContent& content, int width, int height) {
    double s = std::max(height / 720.0, k_least_scale);
    LegendLayout layout = lay_out(content, s);
    for (int i = 0; i < 8; ++i) { // rounding makes the size not quite proportional
        const double fraction = std::min((height - 2.0 * k_margin * s) / layout.panel.height,
                                         k_widest_fraction * width / layout.panel.width);
        if (fraction >= 1.0) {
            break;
        }
        s *= 0.98 * fraction;
        layout = lay_out(content, s);
    }
    move(layout, std::floor(width - layout.panel.width - k_margin * s), std::floor(k_margin * s));
    return layout;
}

void draw_legend(Image& image, const LegendContent& content) {
    const LegendLayout layout = lay_out_legend(content, image.width, image.height);
    const double s = layout.scale;
    const ColourScale& scale = content.scale;
    fill_rounded(image, layout.panel, 7.0 * s, k_panel, k_panel_opacity);

    fill_rounded(image, layout.above, 0.0, scale.map->above, 1.0);
    fill_rounded(image, layout.below, 0.0, scale.map->below, 1.0);
    for (int row = 0; row < static_cast<int>(layout.bar.height); ++row) {
        const double fraction = 1.0 - (row + 0.5) / layout.bar.height;
        fill_rounded(image, {layout.bar.x, layout.bar.y + row, layout.bar.width, 1.0}, 0.0,
                     scale.colour(scale.low + fraction * (scale.high - scale.low)), 1.0);
    }
    const double thin = std::max(1.0, std::round(s));
    for (const std::array<double, 2>& tick : layout.ticks) {
        fill_rounded(image, {tick[0], std::round(tick[1] - 0.5 * thin), k_tick * s, thin}, 0.0,
                     k_quiet, 1.0);
    }
    for (const std::array<double, 2>& marker : layout.markers) {
        const double x = marker[0] - 2.0 * s;
        const double half = 0.55 * k_marker * s;
        fill_triangle(image,
                      {{{x, marker[1]},
                        {x - k_marker * s, marker[1] - half},
                        {x - k_marker * s, marker[1] + half}}},
                      k_text, 1.0);
    }
    for (const LegendText& text : layout.texts) {
        const Font font(text.size);
        font.draw(image, text.box.x, text.box.y + font.ascent(), text.text,
                  text.quiet ? k_quiet : k_text);
    }
}

Ticks round_ticks(double low, double high, int most) {
    assert(low < high && most >= 2);
    const double least_step = (high - low) / most;
    int exponent = static_cast<int>(std::floor(std::log10(least_step)));
    Ticks ticks;
    for (;; ++exponent) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double step = factor * std::pow(10.0, exponent);
            const double slack = 1e-9 * (high - low) / step; // the ends count in spite of rounding
            const double first = std::ceil(low / step - slack);
            const double last = std::floor(high / step + slack);
            if (last - first + 1.0 > most) {
                continue;
            }
            for (double i = first; i <= last; i += 1.0) {
                ticks.values.push_back(std::clamp(i * step, low, high));
            }
            ticks.decimals = std::max(0, -exponent);
            return ticks;
        }
    }
}

std::string format_number(double value, int decimals) {
    if (decimals > 6 || std::abs(value) >= 1e6) {
        return fmt::format("{:.3g}", value);
    }
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') {
        text.erase(0, 1);
    }
    return text;
}

} // namespace weft
