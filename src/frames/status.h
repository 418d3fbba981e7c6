#pragma once

#include <filesystem>
#include <string>

namespace weft {

enum class RunState { Running, Done, Failed, Stopped };

/// What status.json says: for scripts that watch a run. Times are wall-clock seconds.
struct RunStatus {
    RunState state = RunState::Running;
    int frame = 0;  ///< last complete frame; 0: none yet
    int frames = 0; ///< length of the whole run
    double seconds_per_frame = 0.0;
    double seconds_left = 0.0;
    int exit_code = 0;   ///< the process returned it; 0 while it runs
    std::string message; ///< why it ended; empty while it runs
};

/// Replaces the file. Adds percent, the process id and the program's version.
void write_status(const std::filesystem::path& file, const RunStatus& status);

/// Throws Error (Disk) in one line when the file is missing or not a status.
RunStatus read_status(const std::filesystem::path& file);

/// The version of this program, e.g. "0.1.0".
std::string program_version();

} // namespace weft
