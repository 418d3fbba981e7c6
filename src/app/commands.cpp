#include "app/commands.h"

#include "scene/key.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <algorithm>

namespace weft {
namespace {

/// What is wrong with the line, in one; a misspelt verb is named with the nearest.
std::string
describe(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        verbs.push_back(verb->get_name());
    }
    const std::string first = argc > 1 ? argv[1] : "-";
    if (!first.starts_with('-') && std::find(verbs.begin(), verbs.end(), first) == verbs.end()) {
        return fmt::format("{}: must be a command; the nearest is {}; see weft --help", first,
                           nearest_key(first, verbs));
    }
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    const bool has_verb = !first.starts_with('-');
    return fmt::format("{}; see weft {}--help", what, has_verb ? first + " " : "");
}

} // namespace

int run_command_line(int argc, const char* const* argv) {
    CLI::App app("Weft: cloth among moving obstacles, to caches, numbers and pictures", "weft");
    app.set_version_flag("--version", "weft " WEFT_VERSION);
    app.require_subcommand(1);
    ExitCode code = ExitCode::Done;
    for (AddCommand* const add_command : k_commands) {
        add_command(app, code);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            return app.exit(error); // --help, --version
        }
        fmt::print(stderr, "weft: error: {}\n", describe(app, error, argc, argv));
        return static_cast<int>(ExitCode::CommandLine);
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
