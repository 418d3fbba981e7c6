#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace weft {

/// Lines of a text with their numbers, from 1.
class LineScanner {
public:
    explicit LineScanner(std::string_view text) : text_(text) {}

    /// False at the end of the text. The line comes without its end ("\n", "\r\n" or "\r").
    bool next(std::string_view& line);
    std::size_t number() const { return number_; }
    /// Bytes from the start of the text to behind the last line given.
    std::size_t offset() const { return at_; }

private:
    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

/// The words of a line, split at spaces and tabs, up to a '#'.
void split_words(std::string_view line, std::vector<std::string_view>& words);

/// A whole word as a number ("1", "-2.5e3", "+.5", "nan", "inf"); none when it is not one. A
/// number too large for a double is infinite, an integer too large is none.
std::optional<double> to_number(std::string_view word);
std::optional<long long> to_integer(std::string_view word);

} // namespace weft
