#pragma once

#include "base/error.h"

namespace CLI {
class App;
}

namespace weft {

/// Parses the command line, runs the command that it names, and turns an exception into one line on
/// stderr and an exit code.
int run_command_line(int argc, const char* const* argv);

/// A verb adds its subcommand, whose callback runs after the whole line is parsed, sets `code` when
/// that is not Done, and throws Error for everything that goes wrong.
using AddCommand = void(CLI::App& app, ExitCode& code);

/// One file a verb. A new one is declared here and named in the list below, in the order of --help.
AddCommand add_simulate_command;
AddCommand add_check_command;
AddCommand add_keys_command;
AddCommand add_fabric_command;
AddCommand add_inspect_command;
AddCommand add_validate_command;
AddCommand add_render_command;

inline constexpr AddCommand* k_commands[] = {
    add_simulate_command, add_check_command,    add_keys_command,   add_fabric_command,
    add_inspect_command,  add_validate_command, add_render_command,
};

} // namespace weft
