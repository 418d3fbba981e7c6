#include "scene/rig_pose.h"

#include "base/hash.h"
#include "base/parallel.h"

#include <algorithm>
#include <cassert>

namespace weft {
namespace {

/// The keys before and behind a time, and how far it is between them, in [0, 1].
struct Between {
    std::size_t before, behind;
    double weight;
};

Between find_between(const std::vector<double>& times, double t) {
    assert(!times.empty());
    const auto next = std::upper_bound(times.begin(), times.end(), t);
    if (next == times.begin()) {
        return {0, 0, 0.0};
    }
    const auto behind = static_cast<std::size_t>(next - times.begin());
    if (next == times.end()) {
        return {behind - 1, behind - 1, 0.0};
    }
    return {behind - 1, behind, (t - times[behind - 1]) / (times[behind] - times[behind - 1])};
}

/// What turns a part's vertices into posed ones.
struct PartPose {
    std::vector<double> weights; ///< one a morph target
    std::vector<Affine> palette; ///< one a bone; of the node when the part has none
};

PartPose pose_part(const RigPart& part, std::span<const Affine> nodes) {
    PartPose pose;
    for (const MorphTarget& target : part.targets) {
        pose.weights.push_back(target.weight);
    }
    for (const Bone& bone : part.bones) {
        pose.palette.push_back(nodes[at(bone.node)] * bone.offset);
    }
    if (part.bones.empty()) {
        pose.palette.push_back(nodes[at(part.node)]);
    }
    return pose;
}

Vec3 pose_vertex(const RigPart& part, const PartPose& pose, std::size_t v) {
    const Vec3& rest = part.positions[v];
    Vec3 x = rest;
    for (std::size_t k = 0; k < part.targets.size(); ++k) {
        if (pose.weights[k] != 0.0) {
            x += pose.weights[k] * (part.targets[k].positions[v] - rest);
        }
    }
    if (part.bones.empty()) {
        return pose.palette[0] * x;
    }
    Vec3 sum = Vec3::Zero();
    for (Index i = part.influence_begin[v]; i < part.influence_begin[v + 1]; ++i) {
        const Influence& influence = part.influences[at(i)];
        sum += influence.weight * (pose.palette[at(influence.bone)] * x);
    }
    return sum;
}

template <typename V> void add(Hash& hash, const V& values) {
    hash.add(std::span(values.data(), static_cast<std::size_t>(values.size())));
}

} // namespace

Vec3 value_at(const KeyFrames<Vec3>& keys, double t) {
    const auto [a, b, s] = find_between(keys.times, t);
    return keys.values[a] + s * (keys.values[b] - keys.values[a]);
}

Eigen::Quaterniond value_at(const KeyFrames<Eigen::Quaterniond>& keys, double t) {
    const auto [a, b, s] = find_between(keys.times, t);
    return keys.values[a].slerp(s, keys.values[b]).normalized();
}

std::vector<double> value_at(const KeyFrames<std::vector<double>>& keys, double t) {
    const auto [a, b, s] = find_between(keys.times, t);
    std::vector<double> value = keys.values[a];
    for (std::size_t i = 0; i < value.size(); ++i) {
        value[i] += s * (keys.values[b][i] - value[i]);
    }
    return value;
}

std::vector<Affine> node_transforms(const Rig& rig, const Animation& animation, double t) {
    std::vector<Affine> nodes;
    for (const RigNode& node : rig.nodes) {
        nodes.push_back(node.rest);
    }
    for (const NodeChannel& channel : animation.channels) {
        Affine& node = nodes[at(channel.node)];
        node = Eigen::Translation3d(value_at(channel.translation, t)) *
               value_at(channel.rotation, t) * Eigen::Scaling(value_at(channel.scale, t));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (rig.nodes[i].parent != k_no_index) {
            nodes[i] = nodes[at(rig.nodes[i].parent)] * nodes[i];
        }
    }
    return nodes;
}

void pose_vertices(const Rig& rig,
                   const Animation& animation,
                   double t,
                   std::span<const SourceVertex> vertices,
                   std::span<Vec3> positions) {
    assert(vertices.size() == positions.size());
    const std::vector<Affine> nodes = node_transforms(rig, animation, t);
    std::vector<PartPose> poses;
    for (const RigPart& part : rig.parts) {
        poses.push_back(pose_part(part, nodes));
    }
    for (const MorphChannel& channel : animation.morphs) {
        poses[at(channel.part)].weights = value_at(channel.weights, t);
    }
    parallel_for(vertices.size(), [&](std::size_t i) {
        const auto [object, vertex] = vertices[i];
        positions[i] = pose_vertex(rig.parts[at(object)], poses[at(object)], at(vertex));
    });
}

std::vector<Index> motion_groups(const Rig& rig) {
    constexpr Index k_skinned = -2;
    std::vector<char> is_animated(rig.nodes.size(), 0);
    for (const Animation& animation : rig.animations) {
        for (const NodeChannel& channel : animation.channels) {
            is_animated[at(channel.node)] = 1;
        }
    }
    std::vector<Index> groups;
    for (const RigPart& part : rig.parts) {
        Index node = part.node;
        while (node != k_no_index && !is_animated[at(node)]) {
            node = rig.nodes[at(node)].parent;
        }
        groups.push_back(part.bones.empty() ? node : k_skinned);
    }
    return groups;
}

std::uint64_t fingerprint(const Rig& rig, const Animation& animation) {
    Hash hash;
    for (const RigNode& node : rig.nodes) {
        add(hash, node.rest.matrix());
    }
    for (const RigPart& part : rig.parts) {
        add(hash, part.positions);
        for (const MorphTarget& target : part.targets) {
            add(hash, target.positions);
        }
        for (const Bone& bone : part.bones) {
            add(hash, bone.offset.matrix());
        }
        for (const Influence& influence : part.influences) {
            hash.add(std::span(&influence.bone, 1));
            hash.add(std::span(&influence.weight, 1));
        }
    }
    for (const NodeChannel& channel : animation.channels) {
        add(hash, channel.translation.times);
        add(hash, channel.translation.values);
        add(hash, channel.rotation.times);
        for (const Eigen::Quaterniond& q : channel.rotation.values) {
            add(hash, q.coeffs());
        }
        add(hash, channel.scale.times);
        add(hash, channel.scale.values);
    }
    for (const MorphChannel& channel : animation.morphs) {
        add(hash, channel.weights.times);
        for (const auto& weights : channel.weights.values) {
            add(hash, weights);
        }
    }
    return hash.value();
}

} // namespace weft
