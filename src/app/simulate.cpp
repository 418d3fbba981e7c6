#include "app/commands.h"
#include "app/options.h"
#include "app/signals.h"
#include "app/simulation.h"
#include "app/summary.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "collide/contact_surface.h"
#include "frames/acceptance.h"
#include "frames/run_folder.h"
#include "scene/scene_writer.h"
#include "start/prepare.h"
#include "state/build_world.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace weft {

namespace {

struct SimulateOptions {
    CommonOptions common;
    InputOptions input;
    double time_limit = k_forever; ///< s
};

FolderMode folder_mode(const CommonOptions& options) {
    return options.resume      ? FolderMode::Resume
           : options.overwrite ? FolderMode::Overwrite
                               : FolderMode::Fresh;
}

/// Prints what would be simulated; refuses what would be refused at once.
ExitCode describe_start(const Scene& scene, World& world) {
    const bool cures = scene.contact.start_overlap != StartOverlap::Error;
    if (!cures) {
        cure_start_overlap(world, scene, [] { return false; });
    }
    fmt::print("{}", summarise(scene, world));
    const std::vector<UnresolvedPair> pairs = crossings_of_contact(world, scene.contact);
    if (!pairs.empty()) {
        fmt::print("start: {}\n", describe_crossings(world, pairs));
    }
    return ExitCode::Done;
}

std::string describe_cure(const StartOverlapReport& report) {
    const std::string grown =
        report.preroll_substeps > 0
            ? fmt::format("; obstacles grew by {:.3g} m over {} substeps before the first frame",
                          report.deepest_inset, report.preroll_substeps)
            : "";
    return fmt::format("start: {} pairs of triangles crossed, now none: cloth was moved by at most "
                       "{:.3g} m, {} rounds of untangling{}",
                       report.pairs_before, report.max_displacement, report.rounds, grown);
}

/// Prepares the world for its first frame and says what overlap took, also into `told`. Nothing:
/// asked to stop meanwhile.
std::optional<Prepared>
start(const Scene& scene, World built, double time_limit, std::vector<std::string>& told) {
    const StopSignals signals;
    const Stopwatch watch;
    auto preparation = prepare(std::move(built), scene, [&] {
        return StopSignals::received() != 0 || watch.seconds() > time_limit;
    });
    if (!preparation) {
        warn("stopped before the first frame: nothing was written");
        return std::nullopt;
    }
    if (preparation->overlap.pairs_before > 0) {
        told.push_back(describe_cure(preparation->overlap));
        spdlog::info("{} ({:.2f} s)", told.back(), watch.seconds());
    }
    return std::move(preparation->start);
}

ExitCode simulate_scene(const SimulateOptions& options, const Scene& scene) {
    const CommonOptions& common = options.common;
    const FolderMode mode = folder_mode(common);
    if (!common.dry_run) {
        check_run_folder(common.out, mode);
    }
    set_thread_count(common.threads);
    std::vector<std::string> told;
    const auto tell = [&](const std::string& line) {
        warn("{}", line);
        told.push_back(line);
    };
    World world = build_world(scene, tell);
    for (const std::string& line : thickness_warnings(world, scene.contact)) {
        tell(line);
    }
    if (common.dry_run) {
        return describe_start(scene, world);
    }
    const auto prepared = start(scene, std::move(world), options.time_limit, told);
    if (!prepared) {
        return ExitCode::Stopped;
    }
    const RunFolder folder(common.out, mode);
    open_log(common.verbosity(), folder.paths().log());
    spdlog::debug("weft {}: {} frames into {}", program_version(), scene.scene.frames,
                  folder.paths().folder.string());
    for (const std::string& line : told) {
        spdlog::debug("{}", line); // the terminal has seen it already
    }
    return simulate(scene, *prepared, folder,
                    {.frames = common.frames,
                     .fail_on = common.fail_on,
                     .time_limit = options.time_limit,
                     .verify = common.verify,
                     .verbosity = common.verbosity()});
}

ExitCode run(SimulateOptions options) {
    open_log(options.common.verbosity());
    check_rules(options.common.fail_on, [](const std::string& line) { warn("{}", line); });
    const Scene scene = scene_of_command_line(options.input, options.common);
    if (options.common.print_config) {
        fmt::print("{}", write_scene(scene, std::filesystem::current_path()));
        return ExitCode::Done;
    }
    return simulate_scene(options, scene);
}

} // namespace

void add_simulate_command(CLI::App& app, ExitCode& code) {
    auto options = std::make_shared<SimulateOptions>();
    CLI::App* verb = app.add_subcommand(
        "simulate", "Simulate a scene, or a garment among obstacles: cache, statistics, pictures");
    add_input_options(*verb, options->input);
    add_common_options(*verb, options->common);
    verb->add_option("--time-limit", options->time_limit,
                     "stop after this time with a checkpoint and exit code 75")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber);
    verb->callback([options, &code] { code = run(*options); });
}

} // namespace weft
