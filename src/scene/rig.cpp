#include "scene/rig.h"

#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace weft {
namespace {

/// What assimp's own viewers take when a file does not say how long a tick is.
constexpr double k_ticks_per_second = 25.0;

Affine to_affine(const aiMatrix4x4& m) {
    Affine result;
    result.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, 0.0,
        0.0, 0.0, 1.0;
    return result;
}

Vec3 to_vec(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

double last_key(const Animation& animation) {
    double last = 0.0;
    for (const NodeChannel& channel : animation.channels) {
        last = std::max({last, channel.translation.times.back(), channel.rotation.times.back(),
                         channel.scale.times.back()});
    }
    for (const MorphChannel& channel : animation.morphs) {
        last = std::max(last, channel.weights.times.back());
    }
    return last;
}

class RigReader {
public:
    RigReader(const aiScene& scene, const Eigen::Matrix4d& undo_root) : scene_(scene) {
        // A node of its own, as the file's root may be animated.
        rig_.nodes.push_back({"", k_no_index, Affine(undo_root)});
        add_nodes(*scene.mRootNode, 0);
    }

    Rig read(std::span<const ObjectOrigin> origins) {
        for (const ObjectOrigin& origin : origins) {
            rig_.parts.push_back(read_part(*scene_.mMeshes[origin.mesh], origin.node + 1));
        }
        for (unsigned a = 0; a < scene_.mNumAnimations; ++a) {
            rig_.animations.push_back(read_animation(*scene_.mAnimations[a], origins));
        }
        return std::move(rig_);
    }

private:
    void add_nodes(const aiNode& node, Index parent);
    Index find_node(const aiString& name) const;
    RigPart read_part(const aiMesh& mesh, Index node);
    void read_bones(const aiMesh& mesh, RigPart& part);
    Animation read_animation(const aiAnimation& animation, std::span<const ObjectOrigin> origins);
    NodeChannel read_channel(const aiNodeAnim& channel, Index node, double ticks) const;
    void silence_pivots(Index node, Animation& animation) const;
    bool is_meant(const std::string& name, const ObjectOrigin& origin) const;
    KeyFrames<std::vector<double>>
    read_weights(const aiMeshMorphAnim& channel, const RigPart& part, double ticks) const;

    const aiScene& scene_;
    Rig rig_;
    std::unordered_map<std::string, Index> node_of_name_; // looked up, never walked
};

void RigReader::add_nodes(const aiNode& node, Index parent) {
    const auto index = static_cast<Index>(rig_.nodes.size());
    rig_.nodes.push_back({node.mName.C_Str(), parent, to_affine(node.mTransformation)});
    node_of_name_.try_emplace(node.mName.C_Str(), index);
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        add_nodes(*node.mChildren[i], index);
    }
}

Index RigReader::find_node(const aiString& name) const {
    const auto found = node_of_name_.find(name.C_Str());
    return found == node_of_name_.end() ? k_no_index : found->second;
}

RigPart RigReader::read_part(const aiMesh& mesh, Index node) {
    RigPart part;
    part.node = node;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        part.positions.push_back(to_vec(mesh.mVertices[v]));
    }
    for (unsigned k = 0; k < mesh.mNumAnimMeshes; ++k) {
        const aiAnimMesh& target = *mesh.mAnimMeshes[k];
        MorphTarget morph{target.mName.C_Str(), target.mWeight, part.positions};
        for (unsigned v = 0; target.HasPositions() && v < mesh.mNumVertices; ++v) {
            if (v < target.mNumVertices && to_vec(target.mVertices[v]).allFinite()) {
                morph.positions[v] = to_vec(target.mVertices[v]);
            }
        }
        part.targets.push_back(std::move(morph));
    }
    read_bones(mesh, part);
    return part;
}

/// Weights by vertex, made to sum to 1; a vertex that no bone holds hangs on the mesh's node.
void RigReader::read_bones(const aiMesh& mesh, RigPart& part) {
    std::vector<std::vector<Influence>> of_vertex(mesh.mNumVertices);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const Index node = find_node(bone.mName);
        const Affine offset = to_affine(bone.mOffsetMatrix);
        if (node == k_no_index || !offset.matrix().allFinite()) {
            rig_.warnings.push_back(
                fmt::format("bone \"{}\" was left out: no node has this name", bone.mName.C_Str()));
            continue;
        }
        const auto index = static_cast<Index>(part.bones.size());
        part.bones.push_back({node, offset});
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const aiVertexWeight& weight = bone.mWeights[w];
            if (weight.mVertexId < mesh.mNumVertices && std::isfinite(weight.mWeight) &&
                weight.mWeight > 0.0F) {
                of_vertex[weight.mVertexId].push_back({index, weight.mWeight});
            }
        }
    }
    if (part.bones.empty()) {
        return;
    }
    const auto fallback = static_cast<Index>(part.bones.size());
    part.bones.push_back({part.node, Affine::Identity()});
    part.influence_begin.push_back(0);
    for (const auto& influences : of_vertex) {
        double sum = 0.0;
        for (const Influence& influence : influences) {
            sum += influence.weight;
        }
        for (const Influence& influence : influences) {
            part.influences.push_back({influence.bone, influence.weight / sum});
        }
        if (influences.empty()) {
            part.influences.push_back({fallback, 1.0});
        }
        part.influence_begin.push_back(static_cast<Index>(part.influences.size()));
    }
}

std::optional<Vec3> finite_vec(const aiVector3D& v) {
    const Vec3 value = to_vec(v);
    return value.allFinite() ? std::optional(value) : std::nullopt;
}

std::optional<Eigen::Quaterniond> finite_rotation(const aiQuaternion& q) {
    const Eigen::Quaterniond value(q.w, q.x, q.y, q.z);
    const double length = value.norm();
    return std::isfinite(length) && length > 0.0 ? std::optional(value.normalized()) : std::nullopt;
}

/// KeyFrames in seconds; those that are not finite or go back in time are left out. `rest` alone
/// when nothing remains.
template <typename Value, typename Key, typename Convert>
KeyFrames<Value> read_keys(
    const Key* keys, unsigned count, double ticks, const Value& rest, const Convert& convert) {
    KeyFrames<Value> result;
    for (unsigned k = 0; k < count; ++k) {
        const double time = keys[k].mTime / ticks;
        const std::optional<Value> value = convert(keys[k].mValue);
        if (value && std::isfinite(time) && (result.times.empty() || time > result.times.back())) {
            result.times.push_back(time);
            result.values.push_back(*value);
        }
    }
    if (result.times.empty()) {
        result = {{0.0}, {rest}};
    }
    return result;
}

NodeChannel RigReader::read_channel(const aiNodeAnim& channel, Index node, double ticks) const {
    const Affine& rest = rig_.nodes[static_cast<std::size_t>(node)].rest;
    Mat3 axes = rest.linear();
    Vec3 scale = axes.colwise().norm().transpose();
    scale.x() *= axes.determinant() < 0.0 ? -1.0 : 1.0;
    axes.array().rowwise() /= scale.transpose().array();
    return {.node = node,
            .translation = read_keys<Vec3>(channel.mPositionKeys, channel.mNumPositionKeys, ticks,
                                           rest.translation(), finite_vec),
            .rotation =
                read_keys<Eigen::Quaterniond>(channel.mRotationKeys, channel.mNumRotationKeys,
                                              ticks, Eigen::Quaterniond(axes), finite_rotation),
            .scale = read_keys<Vec3>(channel.mScalingKeys, channel.mNumScalingKeys, ticks, scale,
                                     finite_vec)};
}

/// assimp hangs an FBX node below one for each of its pivots. A channel of the node itself holds
/// them all already.
void RigReader::silence_pivots(Index node, Animation& animation) const {
    const auto of = [&](Index i) -> const RigNode& {
        return rig_.nodes[static_cast<std::size_t>(i)];
    };
    const std::string pivots = of(node).name + "_$AssimpFbx$_";
    for (Index i = of(node).parent; i != k_no_index && of(i).name.starts_with(pivots);
         i = of(i).parent) {
        animation.channels.push_back({.node = i,
                                      .translation = {{0.0}, {Vec3::Zero()}},
                                      .rotation = {{0.0}, {Eigen::Quaterniond::Identity()}},
                                      .scale = {{0.0}, {Vec3::Ones()}}});
    }
}

/// glTF names the node, FBX the node and a number behind a star, others the mesh.
bool RigReader::is_meant(const std::string& name, const ObjectOrigin& origin) const {
    const std::string& node = rig_.nodes[static_cast<std::size_t>(origin.node) + 1].name;
    return name == node || name.substr(0, name.find('*')) == node ||
           name == scene_.mMeshes[origin.mesh]->mName.C_Str();
}

KeyFrames<std::vector<double>>
RigReader::read_weights(const aiMeshMorphAnim& channel, const RigPart& part, double ticks) const {
    KeyFrames<std::vector<double>> keys;
    for (unsigned k = 0; k < channel.mNumKeys; ++k) {
        const aiMeshMorphKey& key = channel.mKeys[k];
        const double time = key.mTime / ticks;
        if (!std::isfinite(time) || (!keys.times.empty() && time <= keys.times.back())) {
            continue;
        }
        std::vector<double> weights(part.targets.size(), 0.0);
        for (unsigned i = 0; i < key.mNumValuesAndWeights; ++i) {
            if (key.mValues[i] < weights.size() && std::isfinite(key.mWeights[i])) {
                weights[key.mValues[i]] = key.mWeights[i];
            }
        }
        keys.times.push_back(time);
        keys.values.push_back(std::move(weights));
    }
    return keys;
}

Animation RigReader::read_animation(const aiAnimation& source,
                                    std::span<const ObjectOrigin> origins) {
    Animation animation;
    animation.name = source.mName.C_Str();
    const bool says = std::isfinite(source.mTicksPerSecond) && source.mTicksPerSecond > 0.0;
    const double ticks = says ? source.mTicksPerSecond : k_ticks_per_second;
    for (unsigned c = 0; c < source.mNumChannels; ++c) {
        const Index node = find_node(source.mChannels[c]->mNodeName);
        if (node != k_no_index) {
            animation.channels.push_back(read_channel(*source.mChannels[c], node, ticks));
            silence_pivots(node, animation);
        }
    }
    for (unsigned c = 0; c < source.mNumMorphMeshChannels; ++c) {
        const aiMeshMorphAnim& channel = *source.mMorphMeshChannels[c];
        for (std::size_t i = 0; i < origins.size(); ++i) {
            KeyFrames<std::vector<double>> keys = read_weights(channel, rig_.parts[i], ticks);
            if (is_meant(channel.mName.C_Str(), origins[i]) && !rig_.parts[i].targets.empty() &&
                !keys.times.empty()) {
                animation.morphs.push_back({static_cast<Index>(i), std::move(keys)});
            }
        }
    }
    animation.duration = last_key(animation);
    return animation;
}

} // namespace

Rig read_rig(const aiScene& scene,
             const Eigen::Matrix4d& undo_root,
             std::span<const ObjectOrigin> origins) {
    return RigReader(scene, undo_root).read(origins);
}

} // namespace weft
