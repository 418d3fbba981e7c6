#pragma once

#include "base/log.h"
#include "frames/acceptance.h"
#include "scene/params.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace weft {

/// The frames that a command writes or draws: first, first + step, ... up to last.
struct FrameRange {
    int first = 1;
    int last = 0; ///< 0: the last there is
    int step = 1;

    bool contains(int frame) const {
        return frame >= first && (last == 0 || frame <= last) && (frame - first) % step == 0;
    }
};

/// Reads `A-B`, `A-BxN` or `A` (that frame alone); 1 <= A <= B, N >= 1.
/// Throws Error (CommandLine) in one line when the text is none of these.
FrameRange parse_frame_range(std::string_view text);

/// Throws Error (CommandLine) when the range asks for frames past `frames`, the last of the run.
void check_frame_range(const FrameRange& range, int frames);

/// What every verb that makes or draws a run understands (docs/running.md).
struct CommonOptions {
    std::filesystem::path out;     ///< -o; empty: not given
    FrameRange frames;             ///< -f: what is written
    std::vector<std::string> sets; ///< -s KEY=VALUE, in order
    int threads = 0;               ///< -j; 0 = all cores
    bool resume = false;
    bool overwrite = false;
    bool dry_run = false;      ///< read and check everything, compute and write nothing
    bool print_config = false; ///< the resolved scene to stdout, nothing else
    std::vector<Rule> fail_on;
    bool verify = false; ///< exact crossing test after every substep
    bool quiet = false;
    bool verbose = false;

    /// For open_log.
    Verbosity verbosity() const {
        return quiet ? Verbosity::Quiet : verbose ? Verbosity::Verbose : Verbosity::Normal;
    }
};

/// Adds the common options to a verb. Values are checked while the line is parsed; a bad one ends
/// with exit code 2.
void add_common_options(CLI::App& app, CommonOptions& options);

/// What to simulate: a scene file, or a garment with obstacles and what is said of them.
struct InputOptions {
    std::vector<std::filesystem::path> inputs; ///< SCENE.toml, or GARMENT [OBSTACLE...]
    std::string fabric;                        ///< --fabric; empty: cotton
    std::vector<std::string> pins;             ///< --pin SPEC
    std::string units;                         ///< --units; empty: the files'
    std::string up;                            ///< --up y|z; empty: the files'
};

/// Adds the positional inputs and the options above to a verb.
void add_input_options(CLI::App& app, InputOptions& options);

/// The scene that the command line asks for: of the scene file, or made of garment and obstacles,
/// with every `--set` applied; read and checked, no mesh opened yet. Checks --frames against it.
/// Throws Error: BadInput for the scene, CommandLine for options that do not go together.
Scene scene_of_command_line(const InputOptions& inputs, const CommonOptions& options);

} // namespace weft
