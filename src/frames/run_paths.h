#pragma once

#include <filesystem>
#include <string>

namespace weft {

/// Where each file of a run stands; design, "What a run writes".
struct RunPaths {
    std::filesystem::path folder;

    std::filesystem::path scene() const { return folder / "scene.resolved.toml"; }
    std::filesystem::path stats() const { return folder / "stats.csv"; }
    std::filesystem::path problems() const { return folder / "problems.csv"; }
    std::filesystem::path timing() const { return folder / "timing.csv"; }
    std::filesystem::path images() const { return folder / "images.csv"; }
    std::filesystem::path status() const { return folder / "status.json"; }
    std::filesystem::path log() const { return folder / "log.txt"; }
    std::filesystem::path frames_dir() const { return folder / "frames"; }
    std::filesystem::path cache_dir() const { return folder / "cache"; }
    std::filesystem::path checkpoints_dir() const { return folder / "checkpoints"; }

    /// frames/frame.0001.png
    std::filesystem::path picture(int frame) const;
    /// cache/NAME.0001.ply: what moves by forces and obstacles that deform, one a frame
    std::filesystem::path shape(const std::string& name, int frame) const;
    /// cache/NAME.ply: a rigid obstacle in its own frame, once
    std::filesystem::path obstacle(const std::string& name) const;
    /// cache/NAME.reach.ply: of an obstacle that deforms, points that it gets to
    std::filesystem::path reach(const std::string& name) const;
    /// checkpoints/0010.weft
    std::filesystem::path checkpoint(int frame) const;
    /// checkpoints/failed.weft: the last good state of a run that diverged, for a look at it
    std::filesystem::path failed_checkpoint() const { return checkpoints_dir() / "failed.weft"; }
};

} // namespace weft
