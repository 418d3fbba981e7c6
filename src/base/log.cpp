#include "base/log.h"

#include "base/error.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>

namespace weft {

void open_log(Verbosity verbosity, const std::filesystem::path& file) {
    auto terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    terminal->set_pattern("weft: %l: %v");
    terminal->set_level(verbosity == Verbosity::Quiet    ? spdlog::level::warn
                        : verbosity == Verbosity::Normal ? spdlog::level::info
                                                         : spdlog::level::debug);
    std::vector<spdlog::sink_ptr> sinks{terminal};
    if (!file.empty()) {
        try {
            auto log = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
            log->set_pattern("%Y-%m-%d %H:%M:%S.%e %l %v");
            log->set_level(spdlog::level::debug);
            sinks.push_back(log);
        } catch (const spdlog::spdlog_ex& error) {
            fail_disk("{}: cannot write the log: {}", file.string(), error.what());
        }
    }
    auto logger = std::make_shared<spdlog::logger>("weft", sinks.begin(), sinks.end());
    logger->set_level(spdlog::level::debug);
    logger->flush_on(spdlog::level::info);
    spdlog::set_default_logger(logger);
}

} // namespace weft
