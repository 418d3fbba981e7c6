#pragma once

#include "frames/checkpoint.h"
#include "frames/run_folder.h"
#include "scene/params.h"

#include <functional>
#include <optional>

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

/// Hash of everything that a run's numbers depend on: the scene without [render] and the number of
/// frames, and the geometry that its meshes gave. Where files lie does not matter.
/// @param start the world as build_world made it
std::uint64_t run_hash(const Scene& scene, const World& start);

/// The checkpoint from which the run in a folder goes on; nullopt: from its beginning.
///
/// @param scene_hash run_hash of the scene asked for
/// @param warn       receives a line for each damaged checkpoint
/// Throws Error (CommandLine) when the folder's run has another scene, naming the first line that
/// differs, other meshes, or more frames already; (Disk) when files cannot be read.
std::optional<Checkpoint> find_resume_point(const RunPaths& paths,
                                            const Scene& scene,
                                            std::uint64_t scene_hash,
                                            const std::function<void(const std::string&)>& warn);

} // namespace weft
