#include "app/commands.h"
#include "base/atomic_file.h"
#include "base/log.h"
#include "frames/acceptance.h"
#include "frames/run_folder.h"
#include "frames/statistics_columns.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <map>
#include <memory>

namespace weft {

namespace {

struct CheckOptions {
    std::filesystem::path out;
    std::filesystem::path expectations;
};

/// Tables of a run, each read once.
class RunTables {
public:
    explicit RunTables(const RunPaths& paths)
        : files_{{"stats", paths.stats()}, {"images", paths.images()}, {"timing", paths.timing()}} {
    }

    const std::filesystem::path& file(const std::string& name) const { return files_.at(name); }

    const CsvTable& table(const std::string& name) {
        const auto [at, is_new] = tables_.try_emplace(name);
        if (is_new) {
            const std::string text = read_file(file(name));
            at->second = name == "stats" ? parse_statistics(text, file(name).string())
                                         : parse_csv(text, file(name).string());
        }
        return at->second;
    }

private:
    std::map<std::string, std::filesystem::path> files_;
    std::map<std::string, CsvTable> tables_;
};

ExitCode check(const CheckOptions& options) {
    open_log(Verbosity::Normal);
    std::vector<Expectation> expectations = read_expectations(options.expectations);
    take_current_names(expectations, [](const std::string& line) { warn("{}", line); });
    RunTables tables({options.out});
    std::size_t held = 0;
    for (const Expectation& expect : expectations) {
        const std::string miss =
            find_miss(expect, tables.table(expect.file), tables.file(expect.file).string());
        if (miss.empty()) {
            ++held;
        } else {
            fmt::print("missed: {}\n", miss);
        }
    }
    fmt::print("{} of {} expectations held\n", held, expectations.size());
    return held == expectations.size() ? ExitCode::Done : ExitCode::RuleFailed;
}

} // namespace

void add_check_command(CLI::App& app, ExitCode& code) {
    auto options = std::make_shared<CheckOptions>();
    CLI::App* verb = app.add_subcommand(
        "check", "Compare the statistics and picture numbers of a run with bounds");
    verb->add_option("out", options->out, "folder of the run")->required()->type_name("OUT");
    verb->add_option("expectations", options->expectations, "file with [[expect]] tables")
        ->required()
        ->type_name("EXPECT.toml");
    verb->add_flag_callback(
        "--columns",
        [] {
            fmt::print("{}", statistics_page());
            throw CLI::Success();
        },
        "say what the columns of stats.csv mean, and nothing else");
    verb->callback([options, &code] { code = check(*options); });
}

} // namespace weft
