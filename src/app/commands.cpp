#include "app/commands.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

namespace weft {

int run_command_line(int argc, const char* const* argv) {
    CLI::App app("Weft: cloth among moving obstacles, to caches, numbers and pictures", "weft");
    app.set_version_flag("--version", "weft " WEFT_VERSION);
    app.require_subcommand(1);
    ExitCode code = ExitCode::Done;
    add_fabric_command(app, code);
    add_inspect_command(app, code);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int result = app.exit(error);
        return result == 0 ? 0 : static_cast<int>(ExitCode::CommandLine);
    } catch (const Error& error) {
        fmt::print(stderr, "weft: error: {}\n", error.what());
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        fmt::print(stderr, "weft: internal error: {}\n", error.what());
        return static_cast<int>(ExitCode::OurFault);
    }
    return static_cast<int>(code);
}

} // namespace weft
