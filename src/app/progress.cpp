#include "app/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace weft {

double FrameClock::seconds_per_frame(int frame, double elapsed) const {
    return frame > first_ ? elapsed / (frame - first_) : 0.0;
}

double FrameClock::seconds_left(int frame, double elapsed) const {
    return seconds_per_frame(frame, elapsed) * std::max(0, frames_ - frame);
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<long long>(std::lround(std::max(0.0, seconds)));
    if (whole < 60) {
        return fmt::format("{} s", whole);
    }
    if (whole < 3600) {
        return fmt::format("{}:{:02}", whole / 60, whole % 60);
    }
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string
progress_line(const ProgressNumbers& numbers, int frames, const FrameClock& clock, double elapsed) {
    return fmt::format("frame {}/{}  {}%  {:.3g} s/frame  {} left  {} triangles  {} contacts",
                       numbers.frame, frames, 100 * numbers.frame / std::max(1, frames),
                       clock.seconds_per_frame(numbers.frame, elapsed),
                       duration_text(clock.seconds_left(numbers.frame, elapsed)), numbers.triangles,
                       numbers.contacts);
}

Progress::Progress(int first, int frames, Verbosity verbosity)
    : frames_(frames), clock_(first, frames), verbosity_(verbosity),
      terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    finish();
}

bool Progress::is_due(int done) const {
    const bool every = verbosity_ == Verbosity::Verbose;
    const double pause = terminal_ ? k_rewrite : every ? 0.0 : k_interval;
    return verbosity_ != Verbosity::Quiet && (done >= frames_ || elapsed() - shown_at_ >= pause);
}

void Progress::show(const ProgressNumbers& numbers) {
    if (is_due(numbers.frame)) {
        show_line(progress_line(numbers, frames_, clock_, elapsed()));
    }
}

void Progress::show_pictures(int drawn) {
    if (is_due(drawn)) {
        show_line(fmt::format("picture {}/{}  {:.3g} s/picture  {} left", drawn, frames_,
                              clock_.seconds_per_frame(drawn, elapsed()),
                              duration_text(clock_.seconds_left(drawn, elapsed()))));
    }
}

void Progress::show_line(const std::string& line) {
    shown_at_ = elapsed();
    // \033[K clears what a longer line has left behind.
    fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", line, terminal_ ? "\033[K" : "\n");
    std::fflush(stderr);
    open_line_ = terminal_;
}

void Progress::finish() {
    if (open_line_) {
        fmt::print(stderr, "\n");
        open_line_ = false;
    }
}

} // namespace weft
