#include "frames/run_paths.h"

#include <fmt/core.h>

namespace weft {

std::filesystem::path RunPaths::picture(int frame) const {
    return frames_dir() / fmt::format("frame.{:04}.png", frame);
}

std::filesystem::path RunPaths::shape(const std::string& name, int frame) const {
    return cache_dir() / fmt::format("{}.{:04}.ply", name, frame);
}

std::filesystem::path RunPaths::obstacle(const std::string& name) const {
    return cache_dir() / fmt::format("{}.ply", name);
}

std::filesystem::path RunPaths::reach(const std::string& name) const {
    return cache_dir() / fmt::format("{}.reach.ply", name);
}

std::filesystem::path RunPaths::checkpoint(int frame) const {
    return checkpoints_dir() / fmt::format("{:04}.weft", frame);
}

} // namespace weft
