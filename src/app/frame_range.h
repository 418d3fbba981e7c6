#pragma once

#include <string_view>

namespace weft {

/// The frames that a command writes or draws: first, first + step, ... up to last.
struct FrameRange {
    int first = 1;
    int last = 0; ///< 0: the last there is
    int step = 1;

    bool contains(int frame) const {
        return frame >= first && (last == 0 || frame <= last) && (frame - first) % step == 0;
    }
};

/// Reads `A-B`, `A-BxN` or `A` (that frame alone); 1 <= A <= B, N >= 1.
/// Throws Error (CommandLine) in one line when the text is none of these.
FrameRange parse_frame_range(std::string_view text);

/// Throws Error (CommandLine) when the range asks for frames past `frames`, the last of the run.
void check_frame_range(const FrameRange& range, int frames);

} // namespace weft
