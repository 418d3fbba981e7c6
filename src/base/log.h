#pragma once

#include <spdlog/spdlog.h>

#include <filesystem>

namespace weft {

enum class Verbosity { Quiet, Normal, Verbose };

/// Sends messages to stderr: warnings and errors when quiet, infos too when normal, all when
/// verbose. Also to `file` when it is not empty (everything, with time stamps; appended).
void open_log(Verbosity verbosity, const std::filesystem::path& file = {});

/// A message that the user should read; one line, as an error's.
template <typename... Args> void warn(fmt::format_string<Args...> format, Args&&... args) {
    spdlog::warn(fmt::format(format, std::forward<Args>(args)...));
}

} // namespace weft
