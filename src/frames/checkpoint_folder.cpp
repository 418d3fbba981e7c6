#include "frames/checkpoint_folder.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <algorithm>
#include <charconv>

namespace weft {

namespace fs = std::filesystem;

namespace {

/// The frame in "0010.weft", or 0.
int frame_of(const fs::path& file) {
    const std::string stem = file.stem().string();
    int frame = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), frame);
    const bool whole = error == std::errc() && end == stem.data() + stem.size();
    return whole && file.extension() == ".weft" ? frame : 0;
}

/// Frames that have a checkpoint, newest first.
std::vector<int> checkpoint_frames(const RunPaths& paths) {
    std::vector<int> frames;
    std::error_code ignored; // no folder: no checkpoints
    for (const auto& entry : fs::directory_iterator(paths.checkpoints_dir(), ignored)) {
        if (const int frame = frame_of(entry.path())) {
            frames.push_back(frame);
        }
    }
    std::sort(frames.rbegin(), frames.rend());
    return frames;
}

void remove_checkpoint(const RunPaths& paths, int frame) {
    std::error_code ignored; // an old checkpoint too many does no harm
    fs::remove(paths.checkpoint(frame), ignored);
}

} // namespace

void save_checkpoint(const RunPaths& paths, const Checkpoint& checkpoint) {
    write_atomically(paths.checkpoint(checkpoint.frame), encode_checkpoint(checkpoint));
    bool has_fallback = false;
    for (const int frame : checkpoint_frames(paths)) {
        if (frame >= checkpoint.frame) {
            continue;
        }
        if (!has_fallback && frame % k_checkpoint_interval == 0) {
            has_fallback = true;
            continue;
        }
        remove_checkpoint(paths, frame);
    }
}

void drop_checkpoints_after(const RunPaths& paths, int last) {
    for (const int frame : checkpoint_frames(paths)) {
        if (frame > last) {
            remove_checkpoint(paths, frame);
        }
    }
}

std::optional<Checkpoint> newest_checkpoint(const RunPaths& paths,
                                            const std::function<void(const std::string&)>& warn) {
    for (const int frame : checkpoint_frames(paths)) {
        const fs::path file = paths.checkpoint(frame);
        Checkpoint checkpoint;
        std::string problem = decode_checkpoint(read_file(file), checkpoint);
        if (problem.empty() && checkpoint.frame != frame) {
            problem = fmt::format("holds frame {}", checkpoint.frame);
        }
        if (problem.empty()) {
            return checkpoint;
        }
        warn(fmt::format("{}: {}: taking the checkpoint before it", file.string(), problem));
    }
    return std::nullopt;
}

} // namespace weft
