#include "app/commands.h"

#include <CLI/CLI.hpp>

namespace weft {

int run_command_line(int argc, const char* const* argv) {
    CLI::App app("Weft: cloth among moving obstacles, to caches, numbers and pictures", "weft");
    app.set_version_flag("--version", WEFT_VERSION);
    CLI11_PARSE(app, argc, argv);
    return static_cast<int>(ExitCode::Done);
}

} // namespace weft
