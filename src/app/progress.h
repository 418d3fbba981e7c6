#pragma once

#include "base/log.h"
#include "base/stopwatch.h"

#include <cstdio>
#include <string>

namespace weft {

/// What the progress line says of a frame.
struct ProgressNumbers {
    int frame = 0;
    std::size_t triangles = 0;
    int contacts = 0;
};

/// Time estimates of a run: the mean of the frames that this process made.
class FrameClock {
public:
    /// @param first frames complete before this process
    FrameClock(int first, int frames) : first_(first), frames_(frames) {}

    double seconds_per_frame(int frame, double elapsed) const;
    double seconds_left(int frame, double elapsed) const;

private:
    int first_, frames_;
};

/// "1:23:45", "12:34", "8 s".
std::string duration_text(double seconds);

/// The line of a frame, without a line break.
std::string
progress_line(const ProgressNumbers& numbers, int frames, const FrameClock& clock, double elapsed);

/// Progress on stderr: in a terminal one line written over and over; elsewhere a line of its own, a
/// frame at most and one in k_interval seconds at least, so that a log stays short. Nothing when
/// quiet.
class Progress {
public:
    Progress(int first, int frames, Verbosity verbosity);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const ProgressNumbers& numbers);
    /// The same for pictures: how many are drawn.
    void show_pictures(int drawn);
    /// Ends the rewritten line, so that what follows stands on its own.
    void finish();

    double elapsed() const { return watch_.seconds(); }
    const FrameClock& clock() const { return clock_; }

private:
    void show_line(const std::string& line);
    bool is_due(int done) const;

    static constexpr double k_interval = 2.0; ///< s between lines of a log; well below 30
    static constexpr double k_rewrite = 0.1;  ///< s between rewrites; faster only flickers

    int frames_;
    FrameClock clock_;
    Verbosity verbosity_;
    bool terminal_;
    bool open_line_ = false;
    double shown_at_ = -1e9;
    Stopwatch watch_;
};

} // namespace weft
