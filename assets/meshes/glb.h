#pragma once

#include <vector>

#include "walk.h"

namespace weft {

/// Poses at a constant rate.
struct PoseSequence {
    double rate = 25.0; ///< 1/s
    std::vector<Pose> poses;
};

/// Writes a skinned, animated figure as binary glTF 2.0; vertices keep their order, each hangs on
/// its four heaviest joints. Throws std::runtime_error when the file cannot be written.
void write_glb(const std::filesystem::path& path,
               const std::string& animation,
               const Figure& figure,
               const Skeleton& skeleton,
               const Eigen::MatrixXd& weights,
               const PoseSequence& sequence);

} // namespace weft
