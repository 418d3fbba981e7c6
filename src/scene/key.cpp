#include "scene/key.h"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace weft {

namespace {

/// The number at the start of `text`, after blanks; none when there is no number.
std::optional<double> number_at_start(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc{} ? std::optional(number) : std::nullopt;
}

/// Reads `> 0`, `>= 0`, `< 1` or `<= 1` at the start of `text`.
void read_inequality(std::string_view text, Range& range) {
    const bool is_low = text[0] == '>';
    const bool is_open = !text.substr(1).starts_with('=');
    if (const std::optional<double> bound = number_at_start(text.substr(is_open ? 1 : 2))) {
        (is_low ? range.low : range.high) = *bound;
        (is_low ? range.is_low_open : range.is_high_open) = is_open;
    }
}

/// Reads `1 to 100` or `0 to below 1`.
void read_interval(std::string_view text, Range& range) {
    constexpr std::string_view k_to = " to ";
    constexpr std::string_view k_below = "below ";
    const std::size_t to = text.find(k_to);
    if (to == std::string_view::npos) {
        return;
    }
    std::string_view last = text.substr(to + k_to.size());
    range.is_high_open = last.starts_with(k_below);
    if (range.is_high_open) {
        last.remove_prefix(k_below.size());
    }
    range.low = number_at_start(text).value_or(range.low);
    range.high = number_at_start(last).value_or(range.high);
}

/// Finds the first component that is out of its range.
class RangeCheck {
public:
    explicit RangeCheck(const Key& key) : key_(key) {}

    void operator()(int* value) { require(key_.name, 0, *value); }
    void operator()(double* value) { require(key_.name, 0, *value); }
    void operator()(std::optional<double>* value) {
        if (*value) {
            require(key_.name, 0, **value);
        }
    }
    void operator()(const Units& value) { require(key_.name, 0, *value.metres); }
    void operator()(Vec2* value) { require_each(*value); }
    void operator()(Vec3* value) { require_each(*value); }
    void operator()(std::array<int, 2>* value) { require_each(*value); }
    void operator()(std::vector<int>* value) { require_each(*value); }
    void operator()(const Inline& value) {
        const std::string inside = problem_of(value.keys);
        problem_ = inside.empty() ? "" : key_.name + "." + inside;
    }
    template <typename T> void operator()(const T&) {}

    const std::string& problem() const { return problem_; }

private:
    template <typename T> void require(const std::string& name, std::size_t i, T value) {
        if (key_.ranges.empty() || !problem_.empty()) {
            return;
        }
        const Range& range = key_.ranges.of_component(i);
        if (!range.holds(static_cast<double>(value))) {
            problem_ = fmt::format("{} = {}: must be {}", name, value, key_.allowed(range));
        }
    }
    template <typename List> void require_each(const List& values) {
        std::size_t i = 0;
        for (const auto value : values) {
            require(fmt::format("{}[{}]", key_.name, i), i, value);
            ++i;
        }
    }

    const Key& key_;
    std::string problem_;
};

} // namespace

Range::Range(const char* words) : text(words) {
    const std::string bounds = short_text();
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (bounds[i] == '>' || bounds[i] == '<') {
            read_inequality(std::string_view(bounds).substr(i), *this);
        }
    }
    read_interval(bounds, *this);
    assert(std::isfinite(low) || std::isfinite(high));
}

bool Range::holds(double value) const {
    const bool is_above = is_low_open ? value > low : value >= low;
    return is_above && (is_high_open ? value < high : value <= high);
}

Range any_number() {
    return at_least(-std::numeric_limits<double>::infinity(), "");
}

Range more_than(double bound, std::string words) {
    Range range(std::move(words), bound, std::numeric_limits<double>::infinity());
    range.is_low_open = true;
    return range;
}

Range at_least(double bound, std::string words) {
    return {std::move(words), bound, std::numeric_limits<double>::infinity()};
}

Range at_most(double bound, std::string words) {
    return {std::move(words), -std::numeric_limits<double>::infinity(), bound};
}

Key Key::read_if(bool condition) && {
    is_read = condition;
    return std::move(*this);
}

Key Key::checked_if(bool condition) && {
    is_checked = condition;
    return std::move(*this);
}

Key Key::written_if(bool condition) && {
    is_written = condition;
    return std::move(*this);
}

std::string Key::allowed(const Range& range) const {
    const char last = range.text.empty() ? ' ' : range.text.back();
    const bool ends_in_number = last >= '0' && last <= '9';
    return ends_in_number && !unit.empty() ? range.text + " " + unit : range.text;
}

Keys operator+(Keys a, const Keys& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::string problem_of(const Keys& keys) {
    for (const Key& key : keys) {
        RangeCheck check(key);
        if (key.is_checked) {
            std::visit(check, key.value);
        }
        if (!check.problem().empty()) {
            return check.problem();
        }
    }
    return "";
}

namespace {

/// Halves, so that a wrong case costs 1 and any other replacement 2.
int replace_cost(char a, char b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return a == b ? 0 : lower(a) == lower(b) ? 1 : 2;
}

/// Optimal string alignment (Damerau 1964), in halves.
int edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<int> cost((a.size() + 1) * columns);
    const auto at = [&](std::size_t i, std::size_t j) -> int& { return cost[i * columns + j]; };
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                at(i, j) = static_cast<int>(2 * (i + j));
                continue;
            }
            int best = std::min(at(i - 1, j), at(i, j - 1)) + 2;
            best = std::min(best, at(i - 1, j - 1) + replace_cost(a[i - 1], b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                best = std::min(best, at(i - 2, j - 2) + 2);
            }
            at(i, j) = best;
        }
    }
    return cost.back();
}

} // namespace

std::string nearest_key(std::string_view word, std::span<const std::string> candidates) {
    const auto nearest = std::min_element(
        candidates.begin(), candidates.end(), [&](const std::string& a, const std::string& b) {
            return edit_distance(word, a) < edit_distance(word, b);
        });
    return nearest == candidates.end() ? "" : *nearest;
}

} // namespace weft
