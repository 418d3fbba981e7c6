#include "app/commands.h"
#include "app/options.h"
#include "app/pictures.h"
#include "app/signals.h"
#include "base/log.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "frames/run_folder.h"
#include "scene/names.h"
#include "scene/scene_reader.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <span>

namespace weft {

namespace {

struct RenderOptions {
    std::filesystem::path run;
    std::filesystem::path out; ///< empty: into the run itself
    FrameRange frames;
    bool frames_given = false;
    std::vector<std::string> sets;
    std::string map, quantity;
    std::vector<double> range;
    std::vector<int> size;
    std::vector<double> camera; ///< eye, target
    bool no_edges = false, no_legend = false;
    int threads = 0;
    bool quiet = false;

    /// All of them as scene keys, in the order in which they apply.
    std::vector<std::string> all_sets() const;
};

std::vector<std::string> RenderOptions::all_sets() const {
    std::vector<std::string> result;
    if (!map.empty()) {
        result.push_back(fmt::format("render.map=\"{}\"", map));
    }
    if (!quantity.empty()) {
        result.push_back(fmt::format("render.quantity=\"{}\"", quantity));
    }
    if (range.size() == 2) {
        result.push_back(fmt::format("render.range=[{}, {}]", range[0], range[1]));
    }
    if (size.size() == 2) {
        result.push_back(fmt::format("render.size=[{}, {}]", size[0], size[1]));
    }
    if (camera.size() == 6) {
        result.push_back(fmt::format(
            "render.camera={{ eye = [{}, {}, {}], target = [{}, {}, {}], fov_deg = 35 }}",
            camera[0], camera[1], camera[2], camera[3], camera[4], camera[5]));
    }
    if (no_edges) {
        result.emplace_back("render.edges=false");
    }
    if (no_legend) {
        result.emplace_back("render.legend=false");
    }
    result.insert(result.end(), sets.begin(), sets.end());
    return result;
}

/// The scene of the run with the options applied. A range that the scene gives for its own quantity
/// is forgotten when another one is shown.
Scene scene_to_draw(const RenderOptions& options) {
    const std::filesystem::path file = RunPaths{options.run}.scene();
    if (!std::filesystem::exists(file)) {
        fail_disk("{}: not there: the first argument must be the folder of a run", file.string());
    }
    const std::vector<std::string> sets = options.all_sets();
    for (const std::string& set : sets) {
        if (!set.starts_with("render.")) {
            throw Error(ExitCode::CommandLine,
                        fmt::format("--set {}: must be a key of [render]; the rest of a finished "
                                    "run is fixed",
                                    set));
        }
    }
    Scene scene = read_scene(file, sets);
    const bool sets_range = std::any_of(sets.begin(), sets.end(), [](const std::string& set) {
        return set.starts_with("render.range");
    });
    if (!sets_range && scene.render.quantity != read_scene(file).render.quantity) {
        scene.render.has_range = false;
    }
    return scene;
}

std::vector<int> frames_to_draw(const RenderOptions& options, const CachedRun& run) {
    std::vector<int> frames = run.frames();
    if (frames.empty()) {
        fail_disk("{}: holds no frames yet", RunPaths{options.run}.cache_dir().string());
    }
    const int last = frames.back();
    if (options.frames_given) {
        check_frame_range(options.frames, last);
    }
    std::erase_if(frames, [&](int frame) { return !options.frames.contains(frame); });
    if (frames.empty()) {
        throw Error(
            ExitCode::CommandLine,
            fmt::format("--frames: none of them is in the cache of {}", options.run.string()));
    }
    return frames;
}

/// "a, b or c".
std::string one_of(std::span<const std::string_view> names) {
    return fmt::format("{} or {}", fmt::join(names.first(names.size() - 1), ", "), names.back());
}

ExitCode render_run(const RenderOptions& options) {
    open_log(options.quiet ? Verbosity::Quiet : Verbosity::Normal);
    if (options.frames_given && options.out.empty()) {
        throw Error(ExitCode::CommandLine,
                    "--frames: must stand beside -o DIR: the run's own table of pictures holds "
                    "all frames");
    }
    const RunPaths paths{options.run};
    if (options.out.empty() && std::filesystem::exists(paths.status()) &&
        read_status(paths.status()).state != RunState::Done) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("{}: is not finished, its pictures are the run's own: -o must name "
                                "another folder",
                                options.run.string()));
    }
    set_thread_count(options.threads);
    const Scene scene = scene_to_draw(options);
    const CachedRun run(options.run, scene);
    const StopSignals signals;
    const Stopwatch watch;
    int drawn = 0;
    const PictureJob job{.folder = options.out.empty() ? paths.frames_dir() : options.out,
                         .frames = frames_to_draw(options, run),
                         .should_stop = [] { return StopSignals::received() != 0; },
                         .on_frame = [&](int count) { drawn = count; }};
    PictureTable table(options.out.empty() ? paths.images() : options.out / "images.csv");
    const bool is_whole = draw_run(run, scene, picture_bounds(run, scene).motion, job, table);
    spdlog::info("{} pictures in {}, {:.2f} s each", drawn, job.folder.string(),
                 watch.seconds() / std::max(1, drawn));
    return is_whole ? ExitCode::Done : ExitCode::Stopped;
}

} // namespace

void add_render_command(CLI::App& app, ExitCode& code) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* verb =
        app.add_subcommand("render", "Draw a finished or running run again, from its cache alone");
    verb->add_option("RUN", options->run, "folder of the run")->type_name("")->required();
    verb->add_option("-o,--out", options->out, "folder for the pictures [the run's own]")
        ->type_name("DIR");
    verb->add_option_function<std::string>(
            "-f,--frames",
            [options](const std::string& text) {
                options->frames = parse_frame_range(text);
                options->frames_given = true;
            },
            "frames to draw: A-B, every Nth as A-BxN, or A alone; all when left out")
        ->type_name("A-B");
    verb->add_option("--map", options->map, one_of(k_map_names));
    verb->add_option("--quantity", options->quantity, one_of(k_quantity_names));
    verb->add_option("--range", options->range, "colours from LOW to HIGH")
        ->expected(2)
        ->type_name("LOW HIGH");
    verb->add_option("--size", options->size, "of the picture, pixels")
        ->expected(2)
        ->type_name("W H");
    verb->add_option("--camera", options->camera, "where it stands and what it looks at, m")
        ->expected(6)
        ->type_name("EX EY EZ TX TY TZ");
    verb->add_flag("--no-edges", options->no_edges, "without mesh lines");
    verb->add_flag("--no-legend", options->no_legend, "without the legend");
    verb->add_option("-s,--set", options->sets, "set any key of [render]")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    verb->add_option("-j,--threads", options->threads, "threads; 0 = all cores")
        ->check(CLI::Range(0, 1024));
    verb->add_flag("-q,--quiet", options->quiet, "warnings and errors only");
    verb->callback([options, &code] { code = render_run(*options); });
}

} // namespace weft
