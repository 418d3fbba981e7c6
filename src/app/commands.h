#pragma once

#include "base/error.h"

namespace weft {

/// Parses the command line, runs the command that it names, and turns an exception into one line on
/// stderr and an exit code.
int run_command_line(int argc, const char* const* argv);

} // namespace weft
