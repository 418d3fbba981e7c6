#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace weft {

/// Parses the command line, runs the command that it names, and turns an exception into one line on
/// stderr and an exit code.
int run_command_line(int argc, const char* const* argv);

/// Each verb adds its subcommand; its callback runs after the whole line is parsed, sets `code`
/// when that is not Done, and throws Error for everything that goes wrong. One file a verb. (A new
/// verb: declare it here, call it in commands.cpp.)
void add_simulate_command(CLI::App& app, ExitCode& code);
void add_check_command(CLI::App& app, ExitCode& code);
void add_fabric_command(CLI::App& app, ExitCode& code);
void add_inspect_command(CLI::App& app, ExitCode& code);
void add_validate_command(CLI::App& app, ExitCode& code);
void add_render_command(CLI::App& app, ExitCode& code);

} // namespace weft
