#include "app/options.h"

#include "base/error.h"
#include "scene/scene_from_files.h"
#include "scene/scene_reader.h"

#include <CLI/CLI.hpp>

#include <charconv>

namespace weft {

void add_common_options(CLI::App& app, CommonOptions& options) {
    app.add_option("-o,--out", options.out, "folder of the run")->type_name("DIR");
    app.add_option_function<std::string>(
           "-f,--frames",
           [&options](const std::string& text) { options.frames = parse_frame_range(text); },
           "frames to write: A-B, every Nth as A-BxN, or A alone; all when left out")
        ->type_name("A-B");
    app.add_option("-s,--set", options.sets, "set any key of the scene, e.g. scene.frames=10")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("-j,--threads", options.threads, "threads; 0 = all cores")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    CLI::Option* resume =
        app.add_flag("--resume", options.resume, "go on from the last checkpoint in DIR");
    app.add_flag("--overwrite", options.overwrite, "replace the run that is in DIR")
        ->excludes(resume);
    app.add_flag("-n,--dry-run", options.dry_run, "check everything, compute and write nothing");
    app.add_flag("--print-config", options.print_config,
                 "print the scene with every default filled in");
    app.add_option_function<std::vector<std::string>>(
           "--fail-on",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   options.fail_on.push_back(parse_rule(text));
               }
           },
           "exit with 6 when a frame meets the rule: penetration, retries, or e.g. "
           "'stretch_max>1.3'")
        ->type_name("RULE")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    app.add_flag("--verify", options.verify, "look for crossings exactly after every substep");
    CLI::Option* quiet = app.add_flag("-q,--quiet", options.quiet, "warnings and errors only");
    app.add_flag("-v,--verbose", options.verbose, "say more")->excludes(quiet);
}

void add_input_options(CLI::App& app, InputOptions& options) {
    app.add_option("inputs", options.inputs, "SCENE.toml, or a garment and then its obstacles")
        ->type_name("SCENE | GARMENT [OBSTACLE...]")
        ->required();
    app.add_option("--fabric", options.fabric, "of the garment: a preset or a .toml file [cotton]")
        ->type_name("NAME");
    app.add_option("--pin", options.pins,
                   "hold vertices: corners, top, bottom, loop:N, vertices:I,J,.. or "
                   "box:x0,y0,z0,x1,y1,z1; @OBSTACLE behind it to follow one, e.g. top@body")
        ->type_name("SPEC")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false);
    app.add_option("--units", options.units, "of the mesh files: m, cm, mm, in or metres a unit")
        ->type_name("U");
    app.add_option("--up", options.up, "axis that points up in the mesh files")
        ->check(CLI::IsMember({"y", "z"}))
        ->type_name("y|z");
}

namespace {

[[noreturn]] void refuse_range(std::string_view text) {
    throw Error(
        ExitCode::CommandLine,
        fmt::format("--frames {}: must be A-B, A-BxN or A, with 1 <= A <= B and N >= 1", text));
}

/// The number at the front of `text`, which is cut off.
int take_number(std::string_view& text, std::string_view whole) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || number < 1) {
        refuse_range(whole);
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ExitCode::CommandLine, message);
}

/// Options that describe mesh files mean nothing beside a scene file, which has keys for them.
void check_scene_file_alone(const InputOptions& inputs) {
    if (inputs.inputs.size() > 1) {
        refuse(fmt::format("{}: must be the only input after the scene file {}",
                           inputs.inputs[1].string(), inputs.inputs[0].string()));
    }
    const std::pair<const char*, bool> given[] = {{"--fabric", !inputs.fabric.empty()},
                                                  {"--pin", !inputs.pins.empty()},
                                                  {"--units", !inputs.units.empty()},
                                                  {"--up", !inputs.up.empty()}};
    for (const auto& [name, is_given] : given) {
        if (is_given) {
            refuse(fmt::format("{}: must not stand beside a scene file; set the key with --set",
                               name));
        }
    }
}

Scene read_inputs(const InputOptions& inputs, const CommonOptions& options) {
    if (inputs.inputs.empty()) {
        refuse("inputs: must be a scene file, or a garment and its obstacles");
    }
    if (inputs.inputs[0].extension() == ".toml") {
        check_scene_file_alone(inputs);
        return read_scene(inputs.inputs[0], options.sets);
    }
    SceneFiles files{.garment = inputs.inputs[0], .pins = inputs.pins, .units = inputs.units};
    files.obstacles.assign(inputs.inputs.begin() + 1, inputs.inputs.end());
    files.up = inputs.up;
    if (!inputs.fabric.empty()) {
        files.fabric = inputs.fabric;
    }
    return scene_from_files(files, options.sets);
}

} // namespace

FrameRange parse_frame_range(std::string_view text) {
    std::string_view rest = text;
    FrameRange range;
    range.first = take_number(rest, text);
    range.last = range.first;
    if (rest.starts_with('-')) {
        rest.remove_prefix(1);
        range.last = take_number(rest, text);
    }
    if (rest.starts_with('x')) {
        rest.remove_prefix(1);
        range.step = take_number(rest, text);
    }
    if (!rest.empty() || range.last < range.first) {
        refuse_range(text);
    }
    return range;
}

void check_frame_range(const FrameRange& range, int frames) {
    if (range.first > frames || range.last > frames) {
        throw Error(
            ExitCode::CommandLine,
            fmt::format("--frames {}-{}: must end at {} or before, the last frame of the scene",
                        range.first, range.last, frames));
    }
}

Scene scene_of_command_line(const InputOptions& inputs, const CommonOptions& options) {
    Scene scene = read_inputs(inputs, options);
    check_frame_range(options.frames, scene.scene.frames);
    return scene;
}

} // namespace weft
