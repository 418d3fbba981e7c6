#pragma once

#include <chrono>
#include <ctime>

namespace weft {

/// Wall time since it was made or last restarted, s. Never used for a decision, only for reports.
class Stopwatch {
public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    void restart() { start_ = std::chrono::steady_clock::now(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// CPU time that all threads of the process took together since it was made, s.
class CpuStopwatch {
public:
    double seconds() const { return now() - start_; }

private:
    static double now() {
        std::timespec time{};
        ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    double start_ = now();
};

/// Adds the time of its scope to `total` (s).
class ScopedTime {
public:
    explicit ScopedTime(double& total) : total_(total) {}
    ~ScopedTime() { total_ += watch_.seconds(); }
    ScopedTime(const ScopedTime&) = delete;
    ScopedTime& operator=(const ScopedTime&) = delete;

private:
    double& total_;
    Stopwatch watch_;
};

} // namespace weft
