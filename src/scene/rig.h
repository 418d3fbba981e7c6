#pragma once

#include "base/eigen.h"

#include <span>
#include <string>
#include <vector>

struct aiScene;

namespace weft {

/// Maps points: x -> linear * x + translation.
using Affine = Eigen::Affine3d;

/// A node of a file's hierarchy.
struct RigNode {
    std::string name;
    Index parent = k_no_index; ///< stands before its children
    Affine rest;               ///< to the parent's frame, when nothing animates it
};

/// Values at ascending times (s); constant before the first and after the last.
template <typename Value> struct KeyFrames {
    std::vector<double> times;
    std::vector<Value> values;
};

/// What moves a node: its transform is translation * rotation * scale. Tracks are never empty.
struct NodeChannel {
    Index node;
    KeyFrames<Vec3> translation;
    KeyFrames<Eigen::Quaterniond> rotation; ///< unit; the shorter way between two
    KeyFrames<Vec3> scale;
};

/// What moves the weights of a part's morph targets.
struct MorphChannel {
    Index part;
    KeyFrames<std::vector<double>> weights; ///< one a target
};

struct Animation {
    std::string name;
    double duration = 0.0; ///< s
    std::vector<NodeChannel> channels;
    std::vector<MorphChannel> morphs;
};

/// A shape that is blended in with a weight: x + sum of weight * (target - x).
struct MorphTarget {
    std::string name;
    double weight = 0.0; ///< when nothing animates it
    std::vector<Vec3> positions;
};

struct Bone {
    Index node;
    Affine offset; ///< the mesh's own frame into the bone's, when the mesh is as modelled
};

struct Influence {
    Index bone;    ///< index in the part
    double weight; ///< those of a vertex sum to 1
};

/// The vertices of one object of a mesh file, and what they hang on.
struct RigPart {
    Index node = 0;              ///< carries vertices without bones
    std::vector<Vec3> positions; ///< in the mesh's own frame
    std::vector<MorphTarget> targets;
    std::vector<Bone> bones; ///< the last is the part's node, for vertices that no bone holds
    std::vector<Index> influence_begin; ///< vertex v has [v] to [v + 1]; empty without bones
    std::vector<Influence> influences;
};

/// A vertex of a mesh file.
struct SourceVertex {
    Index object; ///< in MeshFile::objects
    Index vertex; ///< in the object's positions
    bool operator==(const SourceVertex&) const = default;
};

/// All that moves in a mesh file: nodes, skinned and morphing parts (one an object of the file),
/// animations. In the file's unit and axes.
struct Rig {
    std::vector<RigNode> nodes;
    std::vector<RigPart> parts;
    std::vector<Animation> animations;
    std::vector<std::string> warnings;
};

/// Where an object of a mesh file comes from.
struct ObjectOrigin {
    Index node;    ///< by the walk from the root, parents first
    unsigned mesh; ///< in aiScene::mMeshes
};

/// Takes hierarchy, bones, morph targets and animations out of assimp's scene. What is damaged is
/// left out: bones of nodes that are not there, weights of vertices that are not there or that are
/// not finite, keys out of order.
///
/// @param undo_root  goes before the root's transform (FileAxes)
/// @param origins    one an object of the file
Rig read_rig(const aiScene& scene,
             const Eigen::Matrix4d& undo_root,
             std::span<const ObjectOrigin> origins);

} // namespace weft
