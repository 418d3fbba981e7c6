#pragma once

#include "frames/checkpoint.h"
#include "frames/run_paths.h"

#include <functional>

namespace weft {

/// Frames between checkpoints: a killed run loses no more than these.
inline constexpr int k_checkpoint_interval = 10;

/// Writes the checkpoint of a frame, then removes all but it and the newest one before it that
/// stands at a multiple of the interval: which ones remain does not depend on where a run was
/// stopped.
void save_checkpoint(const RunPaths& paths, const Checkpoint& checkpoint);

/// The newest checkpoint that can be read; nullopt when there is none. Each damaged one gives a
/// line to `warn`, and the one before it is tried.
std::optional<Checkpoint> newest_checkpoint(const RunPaths& paths,
                                            const std::function<void(const std::string&)>& warn);

/// Removes the checkpoints of later frames: damaged ones that a run has to go back behind.
void drop_checkpoints_after(const RunPaths& paths, int frame);

} // namespace weft
