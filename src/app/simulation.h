#pragma once

#include "app/options.h"
#include "base/error.h"
#include "frames/run_folder.h"
#include "step/prepared.h"

namespace weft {

/// What the command line says of a run beside its scene.
struct SimulationOptions {
    FrameRange frames; ///< whose cache and pictures are wanted
    std::vector<Rule> fail_on;
    double time_limit = k_forever; ///< wall time, s
    bool verify = false;           ///< exact crossing test after every substep
    Verbosity verbosity = Verbosity::Normal;
};

/// Simulates a scene into its folder, from the beginning or from the folder's newest checkpoint,
/// drawing the frames that were asked for meanwhile.
///
/// Returns Done; RuleFailed after a line for each rule that a frame breaks; Stopped when a signal
/// or the time limit ended it and a checkpoint was written. Throws Error for everything else, with
/// status.json saying the same.
ExitCode simulate(const Scene& scene,
                  const Prepared& start,
                  const RunFolder& folder,
                  const SimulationOptions& options);

} // namespace weft
