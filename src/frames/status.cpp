#include "frames/status.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <nlohmann/json.hpp>
#include <unistd.h>

namespace weft {

NLOHMANN_JSON_SERIALIZE_ENUM(RunState,
                             {{RunState::Failed, "failed"},
                              {RunState::Running, "running"},
                              {RunState::Done, "done"},
                              {RunState::Stopped, "stopped"}})

void write_status(const std::filesystem::path& file, const RunStatus& status) {
    const double fraction =
        status.frames > 0 ? static_cast<double>(status.frame) / status.frames : 0;
    nlohmann::ordered_json json{
        {"state", status.state},
        {"frame", status.frame},
        {"frames", status.frames},
        {"percent", 100.0 * fraction},
        {"seconds_per_frame", status.seconds_per_frame},
        {"seconds_left", status.seconds_left},
        {"pid", ::getpid()},
        {"exit_code", status.exit_code},
        {"message", status.message},
        {"version", program_version()},
    };
    // A path in a message may hold bytes that are no UTF-8.
    write_atomically(
        file,
        std::string_view(
            json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"));
}

RunStatus read_status(const std::filesystem::path& file) {
    try {
        const auto json = nlohmann::json::parse(read_file(file));
        return {.state = json.at("state").get<RunState>(),
                .frame = json.at("frame").get<int>(),
                .frames = json.at("frames").get<int>(),
                .seconds_per_frame = json.at("seconds_per_frame").get<double>(),
                .seconds_left = json.at("seconds_left").get<double>(),
                .exit_code = json.at("exit_code").get<int>(),
                .message = json.at("message").get<std::string>()};
    } catch (const nlohmann::json::exception&) {
        fail_disk("{}: not a status that weft wrote", file.string());
    }
}

std::string program_version() {
    return WEFT_VERSION;
}

} // namespace weft
