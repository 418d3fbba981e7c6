#include "app/commands.h"
#include "base/atomic_file.h"
#include "base/parallel.h"
#include "validation/experiments.h"
#include "validation/table.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <filesystem>
#include <memory>

namespace weft {

namespace {

struct ValidateOptions {
    std::filesystem::path out;
    std::string only;
    bool thorough = false;
    bool list = false;
    bool overwrite = false;
    int threads = 0;
};

void list_experiments() {
    for (const Experiment& experiment : experiments()) {
        fmt::print("{:<20} {}\n", experiment.name, experiment.subject);
    }
}

/// Before hours of work: is there something to run, and somewhere to put it?
void check_options(const ValidateOptions& options) {
    bool any = false;
    for (const Experiment& experiment : experiments()) {
        any = any || experiment.name.find(options.only) != std::string_view::npos;
    }
    if (!any) {
        throw Error(
            ExitCode::CommandLine,
            fmt::format("--only {}: must be part of a name of weft validate --list", options.only));
    }
    if (options.out.empty()) {
        throw Error(ExitCode::CommandLine, "-o: missing: the folder for the table");
    }
    std::error_code failure;
    std::filesystem::create_directories(options.out, failure);
    if (failure) {
        fail_disk("{}: {}", options.out.string(), failure.message());
    }
    if (!options.overwrite && !std::filesystem::is_empty(options.out)) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("{}: is not empty: --overwrite replaces the table in it",
                                options.out.string()));
    }
}

void validate(const ValidateOptions& options, ExitCode& code) {
    if (options.list) {
        list_experiments();
        return;
    }
    check_options(options);
    set_thread_count(options.threads);
    const auto announce = [](const Experiment& experiment) {
        fmt::print(stderr, "{}: {}\n", experiment.name, experiment.subject);
    };
    const ValidationRows rows = run_experiments(options.only, options.thorough, announce);
    write_atomically(options.out / "validation.md", markdown_text(rows));
    write_atomically(options.out / "validation.csv", csv_text(rows));
    fmt::print("{}", terminal_text(rows));
    for (const ValidationRow& row : rows) {
        if (!is_within(row)) {
            code = ExitCode::RuleFailed;
        }
    }
}

} // namespace

void add_validate_command(CLI::App& app, ExitCode& code) {
    auto options = std::make_shared<ValidateOptions>();
    CLI::App* verb = app.add_subcommand(
        "validate", "Compare the mechanics with theory: DIR/validation.md and validation.csv");
    verb->add_option("-o,--out", options->out, "folder for the table")->type_name("DIR");
    verb->add_option("--only", options->only, "only experiments whose name contains this")
        ->type_name("NAME");
    verb->add_flag("--thorough", options->thorough,
                   "repeat contact and friction on every mesh with every substep");
    verb->add_flag("--list", options->list, "name the experiments and stop");
    verb->add_flag("--overwrite", options->overwrite, "replace the table that is in DIR");
    verb->add_option("-j,--threads", options->threads, "threads; 0 = all cores")
        ->type_name("N")
        ->check(CLI::NonNegativeNumber);
    verb->callback([options, &code] { validate(*options, code); });
}

} // namespace weft
