#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>

namespace weft {

/// What the process returns; README.md has the table for users.
enum class ExitCode : int {
    Done = 0,
    OurFault = 1,
    CommandLine = 2,
    BadInput = 3,
    Diverged = 4,
    Disk = 5,
    RuleFailed = 6,
    Stopped = 75,
};

/// One line for the user, naming place, value and what is allowed, and the exit code that goes with
/// it.
class Error : public std::runtime_error {
public:
    Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

/// The user's scene or mesh is wrong: `place: value: what is allowed`.
template <typename... Args>
[[noreturn]] void fail_input(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ExitCode::BadInput, fmt::format(format, std::forward<Args>(args)...));
}

/// A file, the disk or the graphics library refused: path and reason.
template <typename... Args>
[[noreturn]] void fail_disk(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ExitCode::Disk, fmt::format(format, std::forward<Args>(args)...));
}

} // namespace weft
