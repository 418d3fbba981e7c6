#include "frames/resume.h"

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/hash.h"
#include "scene/scene_reader.h"
#include "scene/scene_writer.h"

#include <algorithm>
#include <charconv>
#include <sstream>

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

/// The text of what a run's numbers depend on. Mesh files stand by their names alone: a folder may
/// be moved, and what is in them is hashed as geometry.
std::string essence(Scene scene) {
    scene.render = {};
    scene.scene.frames = 1;
    scene.base_dir = "/";
    for (ClothParams& cloth : scene.cloths) {
        cloth.mesh.file = std::filesystem::path(cloth.mesh.file).filename().string();
    }
    for (SolidParams& solid : scene.solids) {
        solid.mesh.file = std::filesystem::path(solid.mesh.file).filename().string();
    }
    for (ObstacleParams& obstacle : scene.obstacles) {
        obstacle.mesh.file = std::filesystem::path(obstacle.mesh.file).filename().string();
        obstacle.animation.cache = std::filesystem::path(obstacle.animation.cache).filename();
    }
    return write_scene(scene, "/");
}

/// The first line of each text where they differ; an ended text gives "nothing".
std::pair<std::string, std::string> first_difference(const std::string& a, const std::string& b) {
    std::istringstream lines_a(a);
    std::istringstream lines_b(b);
    while (true) {
        std::string line_a;
        std::string line_b;
        const bool has_a = static_cast<bool>(std::getline(lines_a, line_a));
        const bool has_b = static_cast<bool>(std::getline(lines_b, line_b));
        if (!has_a || !has_b || line_a != line_b) {
            return {has_a ? line_a : "nothing", has_b ? line_b : "nothing"};
        }
    }
}

void check_same_scene(const RunPaths& paths, const Scene& scene) {
    const std::string before = essence(read_scene(paths.scene()));
    const std::string now = essence(scene);
    if (before != now) {
        const auto [old_line, new_line] = first_difference(before, now);
        throw Error(ExitCode::CommandLine,
                    fmt::format("--resume: {}: has '{}' where the scene now has '{}': must be the "
                                "same but for [render] and scene.frames",
                                paths.scene().string(), old_line, new_line));
    }
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

std::uint64_t run_hash(const Scene& scene, const World& start) {
    const std::string text = essence(scene);
    const std::uint64_t geometry = geometry_hash(start);
    Hash hash;
    hash.add(std::span<const char>(text));
    hash.add(std::span<const std::uint64_t>(&geometry, 1));
    return hash.value();
}

std::optional<Checkpoint> find_resume_point(const RunPaths& paths,
                                            const Scene& scene,
                                            std::uint64_t scene_hash,
                                            const std::function<void(const std::string&)>& warn) {
    if (!std::filesystem::exists(paths.scene())) {
        return std::nullopt; // stopped before it began
    }
    check_same_scene(paths, scene);
    std::optional<Checkpoint> checkpoint = newest_checkpoint(paths, warn);
    if (checkpoint && checkpoint->scene_hash != scene_hash) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("--resume: {}: a mesh file has changed since the run began",
                                paths.folder.string()));
    }
    if (checkpoint && checkpoint->frame > scene.scene.frames) {
        throw Error(ExitCode::CommandLine,
                    fmt::format("--resume: {}: scene.frames = {}: must be at least {}, which the "
                                "run has already",
                                paths.folder.string(), scene.scene.frames, checkpoint->frame));
    }
    return checkpoint;
}

} // namespace weft
