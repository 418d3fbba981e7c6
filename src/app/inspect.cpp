#include "app/commands.h"
#include "app/inspect_mesh.h"
#include "app/inspect_run.h"
#include "app/inspect_scene.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <memory>

namespace weft {

namespace {

struct InspectOptions {
    std::vector<std::string> files;
    std::string units;
    std::string up;
    std::vector<std::string> objects;
    bool repair = false;
    bool as_cloth = false;
    StartInspection start;
};

/// Metres of "m", "cm", "mm", "in" or a number of metres.
double parse_units(const std::string& text) {
    const std::vector<std::pair<const char*, double>> named{
        {"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}};
    for (const auto& [name, metres] : named) {
        if (text == name) {
            return metres;
        }
    }
    double metres = 0.0;
    if (!CLI::detail::lexical_cast(text, metres) || !(metres > 0.0)) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("--units = {}: must be m, cm, mm, in or metres per unit", text));
    }
    return metres;
}

MeshSource source_of(const InspectOptions& options, const std::string& file) {
    MeshSource source;
    source.file = file;
    source.objects = options.objects;
    source.units_given = !options.units.empty();
    source.metres_per_unit = source.units_given ? parse_units(options.units) : 1.0;
    source.up_given = !options.up.empty();
    source.up = source.up_given ? options.up[0] : 'y';
    source.repair = options.repair;
    return source;
}

/// A folder is a run, a .toml a scene, everything else a mesh.
InspectReport describe(const InspectOptions& options, const std::string& file) {
    const std::filesystem::path path(file);
    if (std::filesystem::is_directory(path)) {
        return describe_run(path);
    }
    if (path.extension() == ".toml") {
        return describe_scene(path, options.start);
    }
    return describe_mesh_file(path, source_of(options, file), options.as_cloth);
}

void inspect(const InspectOptions& options, ExitCode& code) {
    const bool is_one_scene =
        options.files.size() == 1 && std::filesystem::path(options.files[0]).extension() == ".toml";
    if (!options.start.ply.empty() && !is_one_scene) {
        throw Error(
            ExitCode::CommandLine,
            fmt::format("-o {}: must go with one scene (.toml), whose crossing triangles it "
                        "gets",
                        options.start.ply.string()));
    }
    bool is_first = true;
    for (const std::string& file : options.files) {
        const InspectReport report = describe(options, file);
        fmt::print("{}{}", is_first ? "" : "\n", report.text);
        is_first = false;
        if (report.is_refused) {
            code = ExitCode::BadInput;
        }
    }
}

} // namespace

void add_inspect_command(CLI::App& app, ExitCode& code) {
    auto options = std::make_shared<InspectOptions>();
    CLI::App* verb = app.add_subcommand(
        "inspect", "Say what is in a mesh, scene or run: counts, size in metres, defects");
    verb->add_option("FILE", options->files, "mesh files, scenes (.toml), folders of runs")
        ->required();
    verb->add_option("--units", options->units, "m, cm, mm, in or metres per unit of the file");
    verb->add_option("--up", options->up, "the file's up axis")
        ->check(CLI::IsMember(std::vector<std::string>{"y", "z"}));
    verb->add_option("--object", options->objects, "only this node or mesh (repeatable)");
    verb->add_flag("--repair", options->repair, "drop degenerate and double triangles first");
    verb->add_flag("--cloth", options->as_cloth, "refuse what only cloth refuses too");
    verb->add_flag("--pairs", options->start.all_pairs,
                   "of a scene: list every pair of triangles that cross at the start");
    verb->add_option("-o,--out", options->start.ply,
                     "of a scene: write the triangles that cross at the start as a PLY")
        ->type_name("FILE.ply");
    verb->callback([options, &code] { inspect(*options, code); });
}

} // namespace weft
