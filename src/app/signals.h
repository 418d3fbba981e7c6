#pragma once

namespace weft {

/// While it lives, SIGINT and SIGTERM ask the run to stop at the next good place instead of ending
/// the process; a second one of the same kind ends it at once. One at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal that came, or 0.
    static int received();
};

} // namespace weft
