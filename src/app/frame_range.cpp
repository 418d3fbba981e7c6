#include "app/frame_range.h"

#include "base/error.h"

#include <charconv>

namespace weft {
namespace {

[[noreturn]] void refuse(std::string_view text) {
    throw Error(
        ExitCode::CommandLine,
        fmt::format("--frames {}: must be A-B, A-BxN or A, with 1 <= A <= B and N >= 1", text));
}

/// The number at the front of `text`, which is cut off.
int take_number(std::string_view& text, std::string_view whole) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || number < 1) {
        refuse(whole);
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

} // namespace

FrameRange parse_frame_range(std::string_view text) {
    std::string_view rest = text;
    FrameRange range;
    range.first = take_number(rest, text);
    range.last = range.first;
    if (rest.starts_with('-')) {
        rest.remove_prefix(1);
        range.last = take_number(rest, text);
    }
    if (rest.starts_with('x')) {
        rest.remove_prefix(1);
        range.step = take_number(rest, text);
    }
    if (!rest.empty() || range.last < range.first) {
        refuse(text);
    }
    return range;
}

void check_frame_range(const FrameRange& range, int frames) {
    if (range.first > frames || range.last > frames) {
        throw Error(
            ExitCode::CommandLine,
            fmt::format("--frames {}-{}: must end at {} or before, the last frame of the scene",
                        range.first, range.last, frames));
    }
}

} // namespace weft
