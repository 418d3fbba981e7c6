#pragma once

#include "state/world.h"

#include <filesystem>
#include <optional>
#include <string>

namespace weft {

/// What continues a run: all of a World that changes in time, bit for bit, and which run it is of.
struct Checkpoint {
    std::uint64_t scene_hash = 0; ///< run_hash of the world at its start
    int frame = 1;
    double time = 0.0;
    double history_dt = 0.0;
    std::vector<Vec3> positions, velocities, previous_positions, previous_velocities;
    std::vector<AttachedState> attached_states;
    std::vector<FrictionHistory> friction_history;
    std::string meshes; ///< meshes of adaptive cloths, see mesh_state.h
};

/// The moving part of a world.
Checkpoint make_checkpoint(const World& world, std::uint64_t scene_hash);

/// Puts the moving part back into a world made of the same scene, at its start (asserted by sizes;
/// the hash tells).
void restore(const Checkpoint& checkpoint, World& world);

/// Bytes: magic, version, scene hash, sizes, checksum, then the state compressed by zstd. Equal
/// checkpoints give equal bytes.
std::string encode_checkpoint(const Checkpoint& checkpoint);

/// What is wrong with the bytes in words ("truncated", "checksum does not match", ..), or "" and
/// the checkpoint in `out`.
std::string decode_checkpoint(std::string_view bytes, Checkpoint& out);

/// FNV-1a of what a run starts from beside its scene file: the state at t = 0, masses, topology,
/// rest shapes and obstacle meshes. Another one: a mesh has changed.
std::uint64_t geometry_hash(const World& start);

} // namespace weft
