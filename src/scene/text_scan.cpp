#include "scene/text_scan.h"

#include <charconv>
#include <cstdlib>
#include <string>
#include <type_traits>

namespace weft {
namespace {

template <typename Number> std::optional<Number> parse_whole(std::string_view word) {
    if (!word.empty() && word.front() == '+') {
        word.remove_prefix(1);
    }
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size()) {
        return std::nullopt;
    }
    if constexpr (std::is_floating_point_v<Number>) {
        if (error == std::errc::result_out_of_range) {
            return std::strtod(std::string(word).c_str(), nullptr); // from_chars leaves 0
        }
    }
    return error == std::errc{} ? std::optional(value) : std::nullopt;
}

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

} // namespace

bool LineScanner::next(std::string_view& line) {
    if (at_ >= text_.size()) {
        return false;
    }
    std::size_t end = at_;
    while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r') {
        ++end;
    }
    line = text_.substr(at_, end - at_);
    const bool two = end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n';
    at_ = std::min(text_.size(), end + (two ? 2 : 1));
    ++number_;
    return true;
}

void split_words(std::string_view line, std::vector<std::string_view>& words) {
    words.clear();
    std::size_t at = 0;
    while (at < line.size()) {
        if (is_space(line[at])) {
            ++at;
            continue;
        }
        if (line[at] == '#') {
            return;
        }
        std::size_t end = at;
        while (end < line.size() && !is_space(line[end])) {
            ++end;
        }
        words.push_back(line.substr(at, end - at));
        at = end;
    }
}

std::optional<double> to_number(std::string_view word) {
    return parse_whole<double>(word);
}

std::optional<long long> to_integer(std::string_view word) {
    return parse_whole<long long>(word);
}

} // namespace weft
