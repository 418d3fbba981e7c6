#pragma once

#include "base/eigen.h"

#include <string>

struct aiScene;

namespace weft {

/// What a file says about its own unit and axes. assimp applies it for COLLADA (in the root node),
/// not for FBX and Blender; here all of them come out alike, in the file's own unit and axes.
struct FileAxes {
    std::string format; ///< assimp's words
    bool states_unit = false;
    double metres_per_unit = 1.0;
    bool states_up = false;
    Mat3 to_y_up = Mat3::Identity(); ///< the file's axes into x right, y up
    char up = 'y';
    Eigen::Matrix4d undo_root = Eigen::Matrix4d::Identity(); ///< goes before the root's transform
};

/// Unit and axes by format: FBX has them in its global settings (unit factor in cm), COLLADA in its
/// root transform, Blender files are in metres and z-up, glTF in metres and y-up; others say
/// nothing.
FileAxes read_file_axes(const aiScene& scene);

} // namespace weft
