#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace weft {

/// A standing figure: y up, facing +z, symmetric enough in x, arms away from the body.
struct Figure {
    std::vector<Eigen::Vector3d> vertices; ///< m
    std::vector<std::array<int, 3>> triangles;
};

/// Reads an OBJ file in its own order of vertices, larger faces cut as fans.
/// Throws std::runtime_error when it cannot be read or a face names a vertex that is not there.
Figure read_figure(const std::filesystem::path& path);

/// A straight piece of a bone; what is nearest to its surface is moved by it.
struct BonePiece {
    int joint;
    Eigen::Vector3d from, to; ///< m
    double radius;            ///< m, of the flesh around it
};

struct Joint {
    std::string name;
    int parent;            ///< -1: none; stands before its children
    Eigen::Vector3d place; ///< m
};

/// The joints that move: pelvis first, then chest, arms and legs in two pieces each.
enum JointNumber {
    Pelvis,
    Chest,
    LeftArm,
    LeftForearm,
    RightArm,
    RightForearm,
    LeftThigh,
    LeftShin,
    RightThigh,
    RightShin,
    JointCount
};

struct Skeleton {
    std::vector<Joint> joints; ///< by JointNumber
    std::vector<BonePiece> pieces;
};

/// Finds the joints from slices of the mesh: the crotch is where the legs meet, the armpit where
/// the gap beside the chest closes, the rest follows from these and from the height.
/// Throws std::runtime_error when there is no such crotch or armpit.
Skeleton fit_skeleton(const Figure& figure);

} // namespace weft
